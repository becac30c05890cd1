#include "hypothesis/expand_consensus.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace vantage::reconstruction::detail {
namespace {

constexpr double kPoseChiSquare = 22.5;  // 99.9 %, six degrees of freedom

/// How well a correspondence would fit, and how sure that is.
struct InlierCandidate {
  const Correspondence* correspondence = nullptr;
  double cost = 0;        ///< -2 log likelihood of the correspondence, given the pose so far
  bool expected = false;  ///< it is where the pose, which is sure of the place, has it
};

/// How much an hypothesis with the information H has to bend for more evidence: by first order,
/// chi-square rises by c - bᵀ (H + A)⁻¹ b, the squared Mahalanobis distance of what is seen from
/// what was predicted.
struct InnovationGate {
  Eigen::LLT<Matrix6d> both;
  double distance;

  InnovationGate(const Matrix6d& information, const LinearSystem& e)
      : both(Matrix6d(information + e.information)),
        distance(e.chi_square - e.gradient.dot(both.solve(e.gradient))) {}

  double log_determinant() const { return 2 * both.matrixLLT().diagonal().array().log().sum(); }
};

/// The determinants are the density of what was predicted.
std::optional<InlierCandidate> offer_of(const Correspondence& correspondence,
                                        const PoseHypothesis& so_far,
                                        const Eigen::LLT<Matrix6d>& known, double log_known,
                                        const InlierThresholds& thresholds) {
  const Matrix6d& information = so_far.sum.information;
  const double limit = thresholds.largest_chi_square(correspondence);
  const auto system = [&](std::size_t max_points) {
    return linear_system_of(correspondence, so_far.T_world_object, thresholds.min_sigma_px(),
                            max_points);
  };
  // One point is never farther off than all of them; of most correspondences this is enough to
  // know.
  const LinearSystem first = system(1);
  if (!first.in_front || !(InnovationGate(information, first).distance <= limit))
    return std::nullopt;
  const LinearSystem e = system(kAllPoints);
  if (!e.in_front) return std::nullopt;
  const InnovationGate bending(information, e);
  if (!(bending.distance <= limit)) return std::nullopt;
  const double vagueness = known.solve(e.information).trace();
  return InlierCandidate{&correspondence, bending.distance + bending.log_determinant() - log_known,
                         e.chi_square <= limit && vagueness <= limit};
}

std::vector<InlierCandidate> offers(const PoseHypothesis& so_far,
                                    std::span<const Correspondence* const> pool,
                                    const std::vector<const Correspondence*>& refused,
                                    const InlierThresholds& thresholds) {
  const Eigen::LLT<Matrix6d> known(so_far.sum.information);
  const double log_known = 2 * known.matrixLLT().diagonal().array().log().sum();
  std::vector<InlierCandidate> found;
  for (const Correspondence* correspondence : pool) {
    if (!so_far.has_room_for(*correspondence)) continue;
    if (std::find(refused.begin(), refused.end(), correspondence) != refused.end()) continue;
    if (const auto offer = offer_of(*correspondence, so_far, known, log_known, thresholds)) {
      found.push_back(*offer);
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const InlierCandidate& a, const InlierCandidate& b) {
                     return a.expected != b.expected ? a.expected : a.cost < b.cost;
                   });
  return found;
}

/// The first offer, and if it is an expected one all others that are.
std::vector<const Correspondence*> accepted(const PoseHypothesis& so_far,
                                            const std::vector<InlierCandidate>& offers, bool many) {
  PoseHypothesis expanded = so_far;
  for (const InlierCandidate& offer : offers) {
    if (!expanded.has_room_for(*offer.correspondence)) continue;
    expanded.correspondences.push_back(offer.correspondence);
    if (!many || !offer.expected) break;
    if (&offer != &offers.back() && !(&offer + 1)->expected) break;
  }
  return std::move(expanded.correspondences);
}

}  // namespace

double InlierThresholds::largest_chi_square(const Correspondence& correspondence) const {
  const SeenPoints* seen = correspondence.measurement->points();
  if (!seen) return kPoseChiSquare;
  const double in_sigmas = inlier_px / std::max(seen->sigma_px, min_sigma_px());
  return double(seen->pixels.size()) * in_sigmas * in_sigmas;
}

bool InlierThresholds::explains(const Correspondence& correspondence,
                                const LinearSystem& system) const {
  return system.in_front && system.chi_square <= largest_chi_square(correspondence);
}

double PoseHypothesis::score(const InlierThresholds& thresholds) const {
  double score = 0;
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    score += each[i].points *
             (1 - each[i].chi_square / thresholds.largest_chi_square(*correspondences[i]));
  }
  return score;
}

bool PoseHypothesis::has_room_for(const Correspondence& correspondence) const {
  return std::none_of(
      correspondences.begin(), correspondences.end(), [&](const Correspondence* other) {
        const bool same_feature = other->feature == correspondence.feature;
        return other->number == correspondence.number ||
               (same_feature && other->measurement->view == correspondence.measurement->view);
      });
}

std::optional<PoseHypothesis> explain(std::vector<const Correspondence*> correspondences,
                                      const Pose& start, const InlierThresholds& thresholds) {
  std::stable_sort(
      correspondences.begin(), correspondences.end(),
      [](const Correspondence* a, const Correspondence* b) { return a->number < b->number; });
  auto refined = refine(correspondences, start, thresholds.min_sigma_px());
  if (!refined) return std::nullopt;
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    if (!thresholds.explains(*correspondences[i], refined->each[i])) return std::nullopt;
  }
  return PoseHypothesis{refined->T_world_object, std::move(correspondences),
                        std::move(refined->each), refined->sum};
}

std::optional<PoseHypothesis> expand_consensus(std::vector<const Correspondence*> seed,
                                               const Pose& start,
                                               std::span<const Correspondence* const> pool,
                                               const InlierThresholds& thresholds) {
  auto expanded = explain(std::move(seed), start, thresholds);
  std::vector<const Correspondence*> refused;
  while (expanded) {
    const std::vector<InlierCandidate> found = offers(*expanded, pool, refused, thresholds);
    if (found.empty()) break;
    auto more = explain(accepted(*expanded, found, true), expanded->T_world_object, thresholds);
    if (!more)
      more = explain(accepted(*expanded, found, false), expanded->T_world_object, thresholds);
    if (more) {
      expanded = std::move(more);
    } else {
      refused.push_back(found.front().correspondence);
    }
  }
  return expanded;
}

}  // namespace vantage::reconstruction::detail
