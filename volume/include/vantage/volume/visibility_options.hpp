#pragma once

#include "vantage/raycore/export.hpp"

namespace vantage {

/// How pixels without a depth are handled.
enum class DepthHoles {
  fill,     ///< filled from the depths around them (thesis 7.4.2), where those are near enough
  unknown,  ///< they stay unknown, so nothing there is free
};

/// How a depth image becomes a visibility mesh. The noise of its depths is not among these: it is
/// the sensor's (`StereoNoise`).
struct VisibilityOptions {
  int step_px = 8;  ///< spacing of vertices in pixels; 1: every pixel
  DepthHoles holes = DepthHoles::fill;
  int fill_reach_px = 24;    ///< no depth is filled in further than this from a measured one
  double offset_sigmas = 3;  ///< offset of the surface away from the camera in σ(z), which removes
                             ///< false shadow from noise

  /// @throws Error bad_input unless 1 <= step_px <= 64, 0 <= fill_reach_px <= 16384, and the offset
  /// is finite and not negative.
  VANTAGE_API void check() const;
  bool operator==(const VisibilityOptions&) const = default;
};

}  // namespace vantage
