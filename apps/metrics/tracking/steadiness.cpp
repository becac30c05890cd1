#include "metrics/tracking/steadiness.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace vantage {
namespace {

constexpr double kSettledM = 0.002, kSettledRad = std::numbers::pi / 180;

using Errors = std::vector<Eigen::Vector<double, 6>>;

JitterSums sums_of(const Errors& errors) {
  if (errors.size() < 2) return {};
  Eigen::Vector<double, 6> mean = Eigen::Vector<double, 6>::Zero();
  for (const auto& error : errors) mean += error / double(errors.size());
  JitterSums sums{.freedom = double(errors.size() - 1), .poses = errors.size()};
  for (const auto& error : errors) {
    sums.translation_m2 += (error - mean).head<3>().squaredNorm();
    sums.rotation_rad2 += (error - mean).tail<3>().squaredNorm();
  }
  return sums;
}

bool settled(const Eigen::Vector<double, 6>& error) {
  return error.head<3>().norm() <= kSettledM && error.tail<3>().norm() <= kSettledRad;
}

/// The standing of the object that has an instant from which on it is due.
const std::map<int, Eigen::Vector<double, 6>>* standing_at(const StandingErrors& errors,
                                                           std::uint64_t object, int due) {
  const std::map<int, Eigen::Vector<double, 6>>* last = nullptr;
  for (const auto& [standing, by_instant] : errors) {
    if (standing.object == object && standing.since <= due) last = &by_instant;
  }
  return last;
}

}  // namespace

Eigen::Vector<double, 6> pose_error(const Pose& estimate, const Pose& truth) {
  const Eigen::AngleAxisd turn(estimate.rotation() * truth.rotation().transpose());
  Eigen::Vector<double, 6> error;
  error << estimate.translation() - truth.translation(), turn.angle() * turn.axis();
  return error;
}

StandingErrors standing_errors(std::span<const TrackFrame> frames,
                               std::span<const ComparedFrame> compared) {
  StandingErrors errors;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const auto matches = matches_of(compared[i]);
    for (std::size_t t = 0; t < matches.size(); ++t) {
      if (!matches[t]) continue;
      const TruthAt& truth = frames[i].truth[compared[i].truth_index[t]];
      const EstimateAt& estimate = frames[i].estimates[compared[i].estimate_index[*matches[t]]];
      errors[{truth.id, truth.since}][int(i)] =
          pose_error(estimate.T_world_object, truth.T_world_object);
    }
  }
  return errors;
}

void JitterSums::add(const JitterSums& other) {
  translation_m2 += other.translation_m2;
  rotation_rad2 += other.rotation_rad2;
  freedom += other.freedom;
  poses += other.poses;
}

Jitter JitterSums::jitter() const {
  if (freedom == 0) return {};
  return {std::sqrt(translation_m2 / freedom), std::sqrt(rotation_rad2 / freedom), poses};
}

ComparedJitter compare_jitter(const StandingErrors& tracked, const StandingErrors& single) {
  ComparedJitter compared;
  for (const auto& [standing, by_instant] : tracked) {
    const auto other = single.find(standing);
    if (other == single.end()) continue;
    Errors ours, theirs;
    for (const auto& [instant, error] : by_instant) {
      const auto same = other->second.find(instant);
      if (same == other->second.end() || instant < standing.since + kEventDelay) continue;
      ours.push_back(error);
      theirs.push_back(same->second);
    }
    compared.tracked.add(sums_of(ours));
    compared.single.add(sums_of(theirs));
  }
  return compared;
}

Lag lag_of(std::span<const TrueEvent> events, const StandingErrors& errors) {
  Lag lag;
  for (const TrueEvent& event : events) {
    if (event.kind != SceneEventKind::moved) continue;
    const auto* standing = standing_at(errors, event.object, event.due);
    const auto found = standing == nullptr
                           ? std::map<int, Eigen::Vector<double, 6>>::const_iterator()
                           : std::ranges::find_if(*standing, [&](const auto& at) {
                               return at.first >= event.due && settled(at.second);
                             });
    if (standing == nullptr || found == standing->end()) {
      ++lag.unsettled;
    } else {
      lag.instants.push_back(found->first - event.due);
    }
  }
  return lag;
}

}  // namespace vantage
