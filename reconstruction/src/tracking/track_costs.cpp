#include "tracking/track_costs.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "tracking/assignment.hpp"

namespace vantage::reconstruction::detail {
namespace {

/// Somewhere in a cubic metre, turned in any way: the negative logarithm of that density.
const double kAnywhere = std::log(8 * std::numbers::pi * std::numbers::pi);

constexpr double kStep_m = 0.15, kStep_rad = 1.0;  ///< of a carried object, between two snapshots
constexpr double kFalse = 0.05;                    ///< detections that are of nothing
constexpr double kWrongPose = 0.02;                ///< poses that are taken for others, e.g. tilted
constexpr double kNever = 1e9;                     ///< costs more than any sum of others

Matrix6d step_covariance() {
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal().head<3>().setConstant(kStep_m * kStep_m);
  covariance.diagonal().tail<3>().setConstant(kStep_rad * kStep_rad);
  return covariance;
}

/// A pose at the same place that noise does not explain: a marker was seen tilted the wrong way, or
/// read wrongly, now or before.
std::optional<double> corrected_cost(const Track& track, const DetectedPose& detected) {
  const double reach_m = kSamePlace * radius_of(*track.type);
  const double apart_m =
      (detected.measured.T_world_object.translation() - track.place.filter.pose().translation())
          .norm();
  if (apart_m > reach_m) return std::nullopt;
  const double volume = 4.0 / 3 * std::numbers::pi * reach_m * reach_m * reach_m;
  return kAnywhere + std::log(volume) - std::log(kWrongPose);
}

/// An object that is being moved is near where it was last; one that was not may be anywhere.
double new_place_cost(const Track& track, const DetectedPose& detected,
                      const MotionChances& chances) {
  if (!track.elsewhere) return kAnywhere - std::log(chances.moves);
  const PoseMeasurement measured =
      like(*track.type, detected.measured, track.elsewhere->filter.pose());
  const double near =
      likelihood_of(track.elsewhere->filter.innovation(measured), step_covariance()).negative_log;
  return std::min(near, kAnywhere) + std::log(2.0);
}

void consider(std::optional<TrackCost>& best, const TrackCost& other) {
  if (!best || other.cost < best->cost) best = other;
}

/// The cost of a pose that fits the other one of the track's place.
std::optional<double> fits_other(const Track& track, const Detection& detection, std::size_t pose) {
  if (!track.place.other) return std::nullopt;
  Place other = track.place;
  other.filter = track.place.other->filter;
  const auto likelihood = fits(other, *track.type, detection, pose);
  if (!likelihood) return std::nullopt;
  return likelihood->negative_log + std::max(0.0, -track.place.other->log_ratio);
}

}  // namespace

PoseMeasurement like(const ObjectType& type, const PoseMeasurement& measured, const Pose& target) {
  PoseMeasurement result = measured;
  result.T_world_object = nearest_equal_pose(type, measured.T_world_object, target);
  return result;
}

std::optional<NormalLikelihood> fits(const Place& place, const ObjectType& type,
                                     const Detection& detection, std::size_t pose) {
  const PoseMeasurement measured = like(type, detection.poses[pose].measured, place.filter.pose());
  const NormalLikelihood likelihood =
      likelihood_of(place.filter.innovation(measured),
                    place.filter.innovation_covariance(measured, place.views == detection.views));
  if (!(likelihood.squared_distance <= kGate)) return std::nullopt;
  return likelihood;
}

std::optional<TrackCost> cost_of(const Track& track, const Detection& detection,
                                 const MotionChances& chances) {
  std::optional<TrackCost> best;
  if (track.gone) return best;  // if it comes back, it is recognised once that is confirmed
  for (std::size_t i = 0; i < detection.poses.size(); ++i) {
    const DetectedPose& detected = detection.poses[i];
    if (detected.type != track.type) continue;
    const double doubt = -std::log(std::max(detected.probability, 1e-9));
    if (const auto here = fits(track.place, *track.type, detection, i)) {
      const double stays = -std::log(1 - chances.moves);
      consider(best, {here->negative_log + stays + doubt, i, Continuation::at_place});
    }
    if (const auto here = fits_other(track, detection, i)) {
      consider(best, {*here + doubt, i, Continuation::at_place});
    }
    if (!track.confirmed()) continue;
    if (const auto cost = corrected_cost(track, detected)) {
      consider(best, {*cost + doubt, i, Continuation::corrected});
    }
    if (track.elsewhere) {
      if (const auto there = fits(*track.elsewhere, *track.type, detection, i)) {
        consider(best, {there->negative_log + std::log(2.0) + doubt, i, Continuation::elsewhere});
      }
    }
    consider(best, {new_place_cost(track, detected, chances) + doubt, i, Continuation::new_place});
  }
  return best;
}

std::vector<std::optional<std::size_t>> assign(std::span<const Track> tracks,
                                               std::span<const double> unseen,
                                               std::span<const Detection> detections,
                                               const MotionChances& chances) {
  // One row for each track; a column for each detection, and one of its own for not being seen.
  // A detection that continues no track costs the same whichever it is: that is taken off its
  // column, so that only those that continue one count.
  const Eigen::Index rows = Eigen::Index(tracks.size());
  const Eigen::Index seen = Eigen::Index(detections.size());
  Eigen::MatrixXd costs = Eigen::MatrixXd::Constant(rows, seen + rows, kNever);
  const double of_none = kAnywhere - std::log(kFalse);
  for (Eigen::Index t = 0; t < rows; ++t) {
    costs(t, seen + t) = unseen[std::size_t(t)];
    for (Eigen::Index d = 0; d < seen; ++d) {
      const auto cost = cost_of(tracks[std::size_t(t)], detections[std::size_t(d)], chances);
      if (cost) costs(t, d) = cost->cost - of_none;
    }
  }
  const auto columns = cheapest_assignment(costs);
  std::vector<std::optional<std::size_t>> assigned(tracks.size());
  for (std::size_t t = 0; columns && t < tracks.size(); ++t) {
    if ((*columns)[t] < detections.size()) assigned[t] = (*columns)[t];
  }
  return assigned;
}

}  // namespace vantage::reconstruction::detail
