#pragma once

#include <span>
#include <vector>

#include "plausibility/checks.hpp"

namespace vantage::volume::detail {

/// Another way in which a camera's pose may have been meant.
struct PoseReading {
  const char* cause;  ///< a sentence for the user, with what to do
  bool inverted;      ///< camera-to-world was given as world-to-camera
  bool opengl;        ///< y up and looking along -z
  double scale;       ///< of the translation

  Pose of(const Pose& T_world_cam) const;
};

std::span<const PoseReading> pose_readings();

/// How well cameras fit the work area: whether it lies in their images, and what they measure in
/// it.
struct AreaFit {
  double coverage = 0;     ///< mean share of the work area that lies in an image
  double measured = 0;     ///< mean share of the readings that lie in or close to the work area
  std::size_t seeing = 0;  ///< cameras that have a good part of it in their image

  double score() const { return coverage * (0.1 + measured); }
};

/// By the poses as a reading has them; null: as they are given.
AreaFit fit_of(const std::vector<const SampledCamera*>& cameras, const PoseReading* reading,
               const Box& work_area);

/// The reading by which most of these cameras see the work area, and measure something there; null
/// if none is convincing.
const PoseReading* better_reading(const std::vector<const SampledCamera*>& cameras,
                                  const Box& work_area);

}  // namespace vantage::volume::detail
