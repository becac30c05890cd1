#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "metrics/bop/error_model.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// A true object at one instant.
struct TruthAt {
  std::uint64_t id = 0;
  std::size_t type = 0;  ///< index of its ErrorModel
  Pose T_world_object = {};
  int since = 0;  ///< the instant from which on it stands there, if it is judged
  /// Whether it has to be found. Not while it is carried, and not before a camera has seen it where
  /// it is now: nobody can know.
  bool judged = true;
  std::vector<Pose> excused = {};  ///< of one that is not judged: where else it may be reported
};

/// An object as a tracker reports it.
struct EstimateAt {
  std::uint64_t id = 0;
  std::size_t type = 0;
  Pose T_world_object = {};
  std::optional<Matrix6d> covariance = {};
};

/// The truth at an instant, and what was reported then.
struct TrackFrame {
  std::vector<TruthAt> truth;
  std::vector<EstimateAt> estimates;
};

/// How alike they are: of ids, for what is judged at one instant.
struct ComparedFrame {
  std::vector<std::uint64_t> truth, estimates;
  Eigen::MatrixXd similarity;  ///< truth × estimates, 0 to 1; 0 between different types
  /// The same by the distance of places alone, whatever the types are.
  Eigen::MatrixXd nearness;
  std::vector<std::size_t> truth_types = {};
  std::vector<std::size_t> truth_index = {}, estimate_index = {};  ///< in the TrackFrame
};

/// 1 − MSSD / (diameter / 2), 0 at least. HOTA's thresholds 0.05, …, 0.95 are then those of MSSD
/// from 0.475 down to 0.025 diameters, which are BOP's. MSSD and not the distance of places, as it
/// knows of rotations and symmetries, and in one unit.
double pose_similarity(const ErrorModel& model, const Pose& estimate, const Pose& truth);

/// Leaves out true objects that are not judged, and the estimates that stand for these.
ComparedFrame compare(const TrackFrame& frame, std::span<const ErrorModel> models);
std::vector<ComparedFrame> compare(std::span<const TrackFrame> frames,
                                   std::span<const ErrorModel> models);

/// For each true object the estimate that stands for it: the largest sum of similarities.
std::vector<std::optional<std::size_t>> matches_of(const ComparedFrame& frame);

}  // namespace vantage
