#include "hypothesis/expand_consensus.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace vantage::detail {
namespace {

constexpr double kPoseChiSquare = 22.5;  // 99.9 %, six degrees of freedom

/// How well a reading would fit, and how sure that is.
struct Offer {
  const Reading* reading = nullptr;
  double cost = 0;        ///< -2 log likelihood of the reading, given the pose so far
  bool expected = false;  ///< it is where the pose, which is sure of the place, has it
};

/// How much an explanation with the information H has to bend for more evidence: by first order,
/// chi-square rises by c - bᵀ (H + A)⁻¹ b, the squared Mahalanobis distance of what is seen from
/// what was predicted.
struct Bending {
  Eigen::LLT<Matrix6d> both;
  double distance;

  Bending(const Matrix6d& information, const Evidence& e)
      : both(Matrix6d(information + e.information)),
        distance(e.chi_square - e.slope.dot(both.solve(e.slope))) {}

  double log_determinant() const { return 2 * both.matrixLLT().diagonal().array().log().sum(); }
};

/// The determinants are the density of what was predicted.
std::optional<Offer> offer_of(const Reading& reading, const Explanation& so_far,
                              const Eigen::LLT<Matrix6d>& known, double log_known,
                              const Bounds& bounds) {
  const Matrix6d& information = so_far.sum.information;
  const double limit = bounds.largest_chi_square(reading);
  const auto evidence = [&](std::size_t most_points) {
    return evidence_of(reading, so_far.T_world_object, bounds.least_sigma_px(), most_points);
  };
  // One point is never farther off than all of them; of most readings this is enough to know.
  const Evidence first = evidence(1);
  if (!first.in_front || !(Bending(information, first).distance <= limit)) return std::nullopt;
  const Evidence e = evidence(kAllPoints);
  if (!e.in_front) return std::nullopt;
  const Bending bending(information, e);
  if (!(bending.distance <= limit)) return std::nullopt;
  const double vagueness = known.solve(e.information).trace();
  return Offer{&reading, bending.distance + bending.log_determinant() - log_known,
               e.chi_square <= limit && vagueness <= limit};
}

std::vector<Offer> offers(const Explanation& so_far, std::span<const Reading* const> pool,
                          const std::vector<const Reading*>& refused, const Bounds& bounds) {
  const Eigen::LLT<Matrix6d> known(so_far.sum.information);
  const double log_known = 2 * known.matrixLLT().diagonal().array().log().sum();
  std::vector<Offer> found;
  for (const Reading* reading : pool) {
    if (!so_far.has_room_for(*reading)) continue;
    if (std::find(refused.begin(), refused.end(), reading) != refused.end()) continue;
    if (const auto offer = offer_of(*reading, so_far, known, log_known, bounds)) {
      found.push_back(*offer);
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const Offer& a, const Offer& b) {
    return a.expected != b.expected ? a.expected : a.cost < b.cost;
  });
  return found;
}

/// The first offer, and if it is an expected one all others that are.
std::vector<const Reading*> accepted(const Explanation& so_far, const std::vector<Offer>& offers,
                                     bool many) {
  Explanation grown = so_far;
  for (const Offer& offer : offers) {
    if (!grown.has_room_for(*offer.reading)) continue;
    grown.readings.push_back(offer.reading);
    if (!many || !offer.expected) break;
    if (&offer != &offers.back() && !(&offer + 1)->expected) break;
  }
  return std::move(grown.readings);
}

}  // namespace

double Bounds::largest_chi_square(const Reading& reading) const {
  const SeenPoints* seen = reading.sighting->points();
  if (!seen) return kPoseChiSquare;
  const double in_sigmas = inlier_px / std::max(seen->sigma_px, least_sigma_px());
  return double(seen->pixels.size()) * in_sigmas * in_sigmas;
}

bool Bounds::explains(const Reading& reading, const Evidence& evidence) const {
  return evidence.in_front && evidence.chi_square <= largest_chi_square(reading);
}

double Explanation::score(const Bounds& bounds) const {
  double score = 0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    score += each[i].points * (1 - each[i].chi_square / bounds.largest_chi_square(*readings[i]));
  }
  return score;
}

bool Explanation::has_room_for(const Reading& reading) const {
  return std::none_of(readings.begin(), readings.end(), [&](const Reading* other) {
    const bool same_feature = other->feature == reading.feature;
    return other->number == reading.number ||
           (same_feature && other->sighting->view == reading.sighting->view);
  });
}

std::optional<Explanation> explain(std::vector<const Reading*> readings, const Pose& start,
                                   const Bounds& bounds) {
  std::stable_sort(readings.begin(), readings.end(),
                   [](const Reading* a, const Reading* b) { return a->number < b->number; });
  auto refined = refine(readings, start, bounds.least_sigma_px());
  if (!refined) return std::nullopt;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!bounds.explains(*readings[i], refined->each[i])) return std::nullopt;
  }
  return Explanation{refined->T_world_object, std::move(readings), std::move(refined->each),
                     refined->sum};
}

std::optional<Explanation> grow(std::vector<const Reading*> seed, const Pose& start,
                                std::span<const Reading* const> pool, const Bounds& bounds) {
  auto grown = explain(std::move(seed), start, bounds);
  std::vector<const Reading*> refused;
  while (grown) {
    const std::vector<Offer> found = offers(*grown, pool, refused, bounds);
    if (found.empty()) break;
    auto more = explain(accepted(*grown, found, true), grown->T_world_object, bounds);
    if (!more) more = explain(accepted(*grown, found, false), grown->T_world_object, bounds);
    if (more) {
      grown = std::move(more);
    } else {
      refused.push_back(found.front().reading);
    }
  }
  return grown;
}

}  // namespace vantage::detail
