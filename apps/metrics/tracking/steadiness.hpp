#pragma once

#include <map>
#include <span>

#include "metrics/tracking/event_scores.hpp"
#include "metrics/tracking/track_frame.hpp"

namespace vantage {

/// The error of an estimate: its place less the true one, and the rotation vector from the true to
/// the estimated rotation, world frame, as `Matrix6d` has it. Symmetries are not taken out: markers
/// tell a symmetric object's poses apart.
Eigen::Vector<double, 6> pose_error(const Pose& estimate, const Pose& truth);

/// While an object stands at one place.
struct Standing {
  std::uint64_t object = 0;
  int since = 0;
  auto operator<=>(const Standing&) const = default;
};

/// Errors of standing objects over time: by standing, then by instant.
using StandingErrors = std::map<Standing, std::map<int, Eigen::Vector<double, 6>>>;

/// @param compared as `compare` makes it of `frames`.
StandingErrors standing_errors(std::span<const TrackFrame> frames,
                               std::span<const ComparedFrame> compared);

/// How much poses of standing objects move about over time.
struct Jitter {
  double translation_m = 0, rotation_rad = 0;  ///< standard deviations of the vectors
  std::size_t poses = 0;                       ///< that it is of
};

/// The sums of several runs' jitter.
struct JitterSums {
  double translation_m2 = 0, rotation_rad2 = 0, freedom = 0;
  std::size_t poses = 0;

  void add(const JitterSums& other);
  Jitter jitter() const;
};

/// Both of the same standings and instants, where both have a pose, without the first `kEventDelay`
/// instants of each standing.
struct ComparedJitter {
  JitterSums tracked, single;
};
ComparedJitter compare_jitter(const StandingErrors& tracked, const StandingErrors& single);

/// When poses are right again after a move.
struct Lag {
  std::vector<int> instants = {};  ///< after the event's `due`, of those that settled
  std::size_t unsettled = 0;       ///< before the next move, or at all
};

/// Until a pose is within 2 mm and 1 degree of the truth.
Lag lag_of(std::span<const TrueEvent> events, const StandingErrors& errors);

}  // namespace vantage
