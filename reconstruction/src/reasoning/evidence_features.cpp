#include "reasoning/evidence_features.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "hypothesis/hypothesis_verification.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kOnSomethingElse = 0.02;  ///< a marker of an object is stuck to another thing
constexpr double kAgreement = 6;           ///< log-odds of another feature that fits, in mm
constexpr double kMaxSeen = 30;
constexpr double kMarkerCoordinates = 8;
constexpr double kLabel = 0.25;  ///< of what a marker says
constexpr double kFar_px = 12;   ///< beyond it a feature lies elsewhere than its object has it
/// Something unknown hides all of an object from a view, or the rest of one that is seen in part:
/// in clutter things are not found either that stand in the way.
constexpr double kAllHidden = 0.5, kPartlyHidden = 0.3;
constexpr double kMeasured = 0.4;  ///< of these, where a depth image would show what is in the way

double log_odds(double probability) {
  return std::log(probability / (1 - probability));
}

/// What a feature says of an object's pose, in markers.
double weight_of(const Observation& seen) {
  if (const auto* points = std::get_if<SeenPoints>(&seen.data)) {
    return 2 * double(points->pixels.size()) / kMarkerCoordinates;
  }
  return std::holds_alternative<SeenPose>(seen.data) ? 1 : kLabel;
}

/// Whether the view's detector looks for features like this one.
bool looks_for(const CameraView& view, const FeatureKey& key, bool looked) {
  if (looked && key.type == "aruco") return true;
  return std::ranges::any_of(view.observations,
                             [&](const Observation& seen) { return seen.key.type == key.type; });
}

std::set<std::size_t> seen_by(const ReconstructedObject& object, std::size_t view) {
  std::set<std::size_t> features;
  for (const Support& support : object.support) {
    const bool there = support.residual_px <= kFar_px;
    if (support.id.view == view && there) features.insert(support.feature);
  }
  return features;
}

}  // namespace

double log_odds_of_seen(const ReconstructedObject& object, std::span<const CameraView> views) {
  std::map<std::size_t, double> weights;  // of each feature
  std::size_t sightings = 0;
  for (const Support& support : object.support) {
    if (support.residual_px > kFar_px) continue;
    const Observation& seen = views[support.id.view].observations[support.id.observation];
    double& weight = weights[support.feature];
    weight = std::max(weight, weight_of(seen));
    ++sightings;
  }
  double sum = 0;
  for (const auto& [feature, weight] : weights) sum += weight;
  const double misread = log_odds(1 - kWrongId);
  if (sightings == 0) return -misread;  // nothing fits to this pose
  if (sightings == 1 || sum <= 0) return misread;
  return std::min(kMaxSeen, log_odds(1 - kOnSomethingElse) + kAgreement * std::max(0.0, sum - 1));
}

MissingFeatures missing_features(const ReconstructedObject& object,
                                 std::span<const CameraView> views, const Presence& presence,
                                 const std::vector<bool>& looked) {
  MissingFeatures missing;
  const auto& features = object.type->features;
  for (std::size_t v = 0; v < views.size(); ++v) {
    if (!views[v].T_world_cam) continue;
    const std::set<std::size_t> seen = seen_by(object, v);
    double all_missed = 1;
    for (std::size_t f = 0; f < features.size(); ++f) {
      if (seen.contains(f) || !looks_for(views[v], features[f].key, looked[v])) continue;
      const double found = presence.found_probability(v, features[f], object.T_world_object);
      all_missed *= 1 - found;
      missing.count += found > 0.5;
    }
    double hidden = seen.empty() ? kAllHidden : kPartlyHidden;
    if (presence.has_depth_beside(v)) hidden *= kMeasured;
    missing.log_ratio += std::log(hidden + (1 - hidden) * all_missed);
  }
  return missing;
}

}  // namespace vantage::reconstruction::detail
