#pragma once

#include "vantage/raycore/export.hpp"

namespace vantage {

/// What becomes of pixels without a depth.
enum class DepthHoles {
  fill,     ///< filled from the depths around them (thesis 7.4.2), where those are near enough
  unknown,  ///< nothing was measured there, so that nothing is free
};

/// How a depth image becomes a visibility mesh. The noise of its depths is not among these: it is
/// the sensor's (`StereoNoise`).
struct VisibilityOptions {
  int step_px = 8;  ///< every so many pixels a vertex; 1: all of them
  DepthHoles holes = DepthHoles::fill;
  int fill_reach_px = 24;    ///< no depth is filled in further than this from a measured one
  double offset_sigmas = 3;  ///< the surface moves back by so many σ(z): what noise makes is gone

  /// @throws Error bad_input unless 1 <= step_px <= 64, 0 <= fill_reach_px <= 16384, and the offset
  /// is finite and not negative.
  VANTAGE_API void check() const;
  bool operator==(const VisibilityOptions&) const = default;
};

}  // namespace vantage
