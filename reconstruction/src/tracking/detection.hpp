#pragma once

#include <span>
#include <vector>

#include "tracking/pose_filter.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

namespace vantage::reconstruction::detail {

/// One way to take a detected object: its pose or one of its alternatives.
struct DetectedPose {
  TypePtr type;
  PoseMeasurement measured;
  double probability = 1;
};

/// An object of a snapshot's reconstruction, as the tracker takes it.
struct Detection {
  const ReconstructedObject* object = nullptr;
  std::vector<DetectedPose> poses;  ///< the likeliest first, never empty
  std::vector<std::size_t> views;   ///< that see it; ascending, each once
};

/// The result points into `snapshot`.
/// Objects of a method without covariances get 5 mm and 3° of noise.
std::vector<Detection> detections_of(const Reconstruction& snapshot,
                                     std::span<const CameraView> views);

}  // namespace vantage::reconstruction::detail
