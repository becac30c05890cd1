#include "tracking/place_update.hpp"

#include <algorithm>

namespace vantage::reconstruction::detail {
namespace {

constexpr double kUnlisted = 0.05;  ///< of a pose that a detection does not have
constexpr double kMaxStep = 3;      ///< one snapshot is not all
constexpr double kSwap = 1, kForget = -9;
constexpr int kMaxDoubtless = 4;

/// The pose of the detection that is likeliest under a filter.
struct BestPose {
  std::optional<PoseMeasurement> measured;
  std::size_t index = 0;
  double log = 0;  ///< of its likelihood; lower where none fits
};

BestPose best_pose(const PoseFilter& filter, const Place& place, const ObjectType& type,
                   const Detection& detection) {
  BestPose best;
  for (std::size_t i = 0; i < detection.poses.size(); ++i) {
    const DetectedPose& detected = detection.poses[i];
    if (detected.type.get() != &type) continue;
    const PoseMeasurement measured = like(type, detected.measured, filter.pose());
    const NormalLikelihood likelihood =
        likelihood_of(filter.innovation(measured),
                      filter.innovation_covariance(measured, place.views == detection.views));
    const double log =
        -likelihood.squared_distance / 2 + std::log(std::max(detected.probability, kUnlisted));
    if (likelihood.squared_distance > kGate || (best.measured && log <= best.log)) continue;
    best = {measured, i, log};
  }
  if (!best.measured) best.log = -kGate / 2 + std::log(kUnlisted);
  return best;
}

/// An alternative of the detection that is at the same place.
std::optional<OtherPose> other_pose(const ObjectType& type, const Detection& detection,
                                    std::size_t index, const PoseMeasurement& pose) {
  for (std::size_t i = 0; i < detection.poses.size(); ++i) {
    const DetectedPose& other = detection.poses[i];
    if (i == index || other.type.get() != &type) continue;
    const PoseMeasurement measured = like(type, other.measured, pose.T_world_object);
    const double apart_m =
        (measured.T_world_object.translation() - pose.T_world_object.translation()).norm();
    if (apart_m > kSamePlace * radius_of(type)) continue;
    return OtherPose{PoseFilter(measured),
                     std::log(std::max(other.probability, kUnlisted) /
                              std::max(detection.poses[index].probability, kUnlisted))};
  }
  return std::nullopt;
}

void swap_poses(Place& place) {
  std::swap(place.filter, place.other->filter);
  place.other->log_ratio = -place.other->log_ratio;
}

}  // namespace

Place place_of(const ObjectType& type, const Detection& detection, std::size_t index,
               const PoseMeasurement& pose, double time_s) {
  return {PoseFilter(pose),
          time_s,
          1,
          time_s,
          detection.views,
          detection.object->support.size(),
          other_pose(type, detection, index, pose)};
}

void see_at(Place& place, const ObjectType& type, const Detection& detection, double time_s) {
  const BestPose mine = best_pose(place.filter, place, type, detection);
  if (place.other) {
    const BestPose others = best_pose(place.other->filter, place, type, detection);
    place.other->log_ratio += std::clamp(others.log - mine.log, -kMaxStep, kMaxStep);
    if (others.measured) place.other->filter.update(*others.measured);
  }
  if (mine.measured) {
    place.filter.update(*mine.measured);
    if (!place.other && place.features < 2) {
      place.other = other_pose(type, detection, mine.index, *mine.measured);
      // Earlier snapshots had no doubt.
      if (place.other) place.other->log_ratio -= std::min(place.seen, kMaxDoubtless);
    }
  }
  if (place.other && place.other->log_ratio > kSwap) swap_poses(place);
  if (place.other && place.other->log_ratio < kForget) place.other.reset();
  place.views = detection.views;
  place.features = std::max(place.features, detection.object->support.size());
  place.seen_s = time_s;
  ++place.seen;
}

}  // namespace vantage::reconstruction::detail
