#include "hypothesis/hypothesis_verification.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "hypothesis/expected_markers.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kMarkerChiSquare = 26.1;  // 99.9 %, eight coordinates

/// The evidence of an object's fit with what its measurements may be off by, beside their noise.
Matrix6d cautious_information(const PoseHypothesis& object, const InlierThresholds& thresholds) {
  LinearSystem sum;
  for (const Correspondence* correspondence : object.correspondences) {
    sum.add(linear_system_of(*correspondence, object.T_world_object, thresholds.min_sigma_px()));
  }
  return sum.information;
}

bool view_has(const PoseHypothesis& object, std::size_t view, std::size_t feature) {
  return std::any_of(object.correspondences.begin(), object.correspondences.end(),
                     [&](const Correspondence* correspondence) {
                       return correspondence->measurement->id.view == view &&
                              correspondence->feature->index == feature;
                     });
}

/// Whether the measurement lies where the object has these corners, from whichever it is counted.
/// Less is forgiven than for correspondences: a marker that stands before another one is not that
/// one.
bool lies_at(const Measurement& measurement, std::vector<Eigen::Vector3d> corners,
             const PoseHypothesis& object, const Matrix6d& information,
             const InlierThresholds& thresholds) {
  Correspondence correspondence{&measurement, 0, object.correspondences.front()->feature, {}, {}};
  for (std::size_t shift = 0; shift < corners.size(); ++shift) {
    correspondence.points_m = corners;
    const LinearSystem e =
        linear_system_of(correspondence, object.T_world_object, thresholds.min_sigma_px());
    if (e.in_front) {
      const Eigen::LLT<Matrix6d> both(Matrix6d(information + e.information));
      const double distance = e.chi_square - e.gradient.dot(both.solve(e.gradient));
      if (distance <= kMarkerChiSquare) return true;
    }
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
  return false;
}

/// The marker of the object for which the measurement was taken; null: none.
const ObjectFeature* really_is(const Measurement& measurement, const PoseHypothesis& object,
                               const Matrix6d& information, const InlierThresholds& thresholds) {
  const SeenPoints* seen = measurement.points();
  if (!seen || seen->pixels.size() != 4) return nullptr;
  const std::vector<ObjectFeature>& features = object.type()->features;
  for (std::size_t f = 0; f < features.size(); ++f) {
    if (!std::holds_alternative<Marker>(features[f].geometry)) continue;
    if (view_has(object, measurement.id.view, f)) continue;
    if (lies_at(measurement, features[f].points(), object, information, thresholds))
      return &features[f];
  }
  return nullptr;
}

}  // namespace

void reject_misidentified(std::vector<Candidate>& candidates, const InlierThresholds& thresholds) {
  std::vector<Matrix6d> information;
  for (const Candidate& candidate : candidates) {
    information.push_back(cautious_information(candidate.best(), thresholds));
  }
  for (Candidate& doubtful : candidates) {
    const auto& correspondences = doubtful.best().correspondences;
    for (std::size_t i = 0; i < candidates.size() && doubtful.rejected.empty(); ++i) {
      const PoseHypothesis& object = candidates[i].best();
      if (object.correspondences.size() < 2 ||
          object.correspondences.size() <= correspondences.size())
        continue;
      const ObjectFeature* marker = nullptr;
      const bool all = std::all_of(correspondences.begin(), correspondences.end(),
                                   [&](const Correspondence* correspondence) {
                                     marker = really_is(*correspondence->measurement, object,
                                                        information[i], thresholds);
                                     return marker != nullptr;
                                   });
      if (!all) continue;
      doubtful.rejected =
          fmt::format("lies where a {} has {}: misread", object.type()->name, name_of(marker->key));
      doubtful.there = 0;
      const std::size_t ways = doubtful.voted_hypotheses.size();
      doubtful.shares.assign(ways, 1 / double(ways));
    }
  }
}

namespace {

constexpr double kMissed = kMarkerMissed, kHidden = kViewHidden;

bool is_weak(const PoseHypothesis& object) {
  return object.correspondences.front()->measurement->id.view ==
         object.correspondences.back()->measurement->id.view;
}

/// The reconstructed objects as they hide markers.
std::shared_ptr<const Scene> scene_of(const std::vector<Candidate>& candidates) {
  SceneBuilder builder;
  for (const Candidate& candidate : candidates) {
    if (!candidate.rejected.empty()) continue;
    builder.add_instance(candidate.best().type()->mesh, candidate.best().T_world_object);
  }
  return builder.build();
}

/// The logarithm of the probability that markers go unseen where they do.
double log_of_unseen(const PoseHypothesis& object, std::span<const CameraView> views,
                     const Scene& scene) {
  double log_probability = 0;
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (!views[v].T_world_cam || views[v].observations.empty()) continue;
    const ExpectedMarkers expected(views[v], scene);
    std::set<std::size_t> seen;
    for (const Correspondence* correspondence : object.correspondences) {
      if (correspondence->measurement->id.view == v) seen.insert(correspondence->feature->index);
    }
    int unseen = 0;
    const auto& features = object.type()->features;
    for (std::size_t f = 0; f < features.size(); ++f) {
      const auto* marker = std::get_if<Marker>(&features[f].geometry);
      if (!marker || seen.contains(f)) continue;
      if (expected.sees(*marker, object.T_world_object)) ++unseen;
    }
    const double missed = std::pow(kMissed, unseen);
    log_probability += std::log(seen.empty() ? kHidden + (1 - kHidden) * missed : missed);
  }
  return log_probability;
}

/// The ways' logarithmic likelihoods become shares; ways far below the best one are dropped.
void share_out(Candidate& candidate, std::vector<double> logs, double min_evidence) {
  std::vector<std::size_t> order(logs.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return goes_before(logs[a], candidate.voted_hypotheses[a].hypothesis, logs[b],
                       candidate.voted_hypotheses[b].hypothesis);
  });
  std::vector<FinalFit> voted_hypotheses;
  double sum = 0;
  candidate.shares.clear();
  for (const std::size_t i : order) {
    const double below = logs[order.front()] - logs[i];
    if (below > min_evidence / 2) continue;
    voted_hypotheses.push_back(std::move(candidate.voted_hypotheses[i]));
    candidate.shares.push_back(std::exp(-below));
    sum += candidate.shares.back();
  }
  for (double& share : candidate.shares) share /= sum;
  candidate.voted_hypotheses = std::move(voted_hypotheses);
}

void verify_hypotheses(Candidate& candidate, std::span<const CameraView> views, const Scene* scene,
                       double min_evidence) {
  const auto by_fit = [](const FinalFit& a, const FinalFit& b) {
    return a.chi_square < b.chi_square;
  };
  const auto fitting = std::min_element(candidate.voted_hypotheses.begin(),
                                        candidate.voted_hypotheses.end(), by_fit);
  const double scale =
      std::max(1.0, fitting->chi_square / std::max(1, fitting->degrees_of_freedom));
  const double least = fitting->chi_square;
  double largest_unseen = 0;
  std::vector<double> logs;
  for (std::size_t i = 0; i < candidate.voted_hypotheses.size(); ++i) {
    const FinalFit& voted = candidate.voted_hypotheses[i];
    const double unseen = scene ? log_of_unseen(voted.hypothesis, views, *scene) : 0;
    if (i == 0 || unseen > largest_unseen) largest_unseen = unseen;
    logs.push_back(-(voted.chi_square - least) / scale / 2 + unseen);
  }
  const double wrong = std::pow(kWrongId, double(candidate.best().correspondences.size()));
  const double right = (1 - wrong) * std::exp(largest_unseen);
  candidate.there = right / (right + wrong);
  share_out(candidate, std::move(logs), min_evidence);
}

}  // namespace

bool goes_before(double log, const PoseHypothesis& voted, double other_log,
                 const PoseHypothesis& other) {
  constexpr double kRounding = 1e-9;
  const double rank = std::round(log / kRounding), other_rank = std::round(other_log / kRounding);
  return rank != other_rank ? rank > other_rank : voted.type()->name < other.type()->name;
}

void verify_hypotheses(std::vector<Candidate>& candidates, std::span<const CameraView> views,
                       const ReconstructOptions& options) {
  const bool any_weak =
      std::any_of(candidates.begin(), candidates.end(), [](const auto& candidate) {
        return candidate.rejected.empty() && is_weak(candidate.best());
      });
  const auto scene = any_weak ? scene_of(candidates) : nullptr;
  for (Candidate& candidate : candidates) {
    if (!candidate.rejected.empty()) continue;
    verify_hypotheses(candidate, views, is_weak(candidate.best()) ? scene.get() : nullptr,
                      options.min_evidence);
    if (candidate.there < 0.5) {
      candidate.rejected = "other markers of a " + candidate.best().type()->name +
                           " there should be seen, but are not: its id is more likely misread";
    }
  }
}

}  // namespace vantage::reconstruction::detail
