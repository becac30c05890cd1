#pragma once

#include <string_view>

#include "vantage/raycore/export.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

/// An active stereo camera: two imagers side by side, and between them a projector that throws a
/// pattern on what has no texture. It measures the depth of what all three of them see, by the
/// disparity between the imagers' pictures. Every effect can be switched off. The default is a
/// RealSense D435, as far as there are sources:
///
/// - `noise`, `disparity_step_px`: see StereoNoise; and 1/32 of a pixel, Grunnet-Jepsen et al.,
///   "Subpixel linearity improvement for Intel RealSense depth camera D400 series" (Intel white
///   paper).
/// - `max_disparity_px`: from the same vendor's tuning guide, MinZ = focal length · baseline / 126.
/// - `projector_m`: the datasheet of the D400 family draws the projector between the imagers,
///   without a measure; we put it in the middle.
/// - `max_incidence_rad`, `border_px`: not published. Ours: a surface seen at 80° is foreshortened
///   to a sixth, too narrow for a matching window; and such a window of 7 × 7 pixels ends 3 pixels
///   before the image does.
///
/// The simulator measures with it, and the planner uses it to predict what a movable camera of this
/// kind will measure (`ExpectedScorer`).
struct VANTAGE_API StereoSensor {
  StereoNoise noise = {};  ///< focal length and baseline also turn depth into disparity
  double disparity_step_px = 1.0 / 32;  ///< 0: not quantised
  double max_disparity_px = 126;        ///< nearer surfaces are not found; 0: no limit
  bool second_imager = true;   ///< a hole where it does not see the surface, or beyond its image
  bool projector = true;       ///< a hole where its light does not reach the surface
  double projector_m = 0.025;  ///< from the first imager towards the second
  double max_incidence_rad = 1.3963;  ///< between the surface's normal and the ray; π/2: no limit
  int border_px = 3;                  ///< without depth along the image's edges
  double flying_pixels = 0;           ///< share of pixels at a jump in depth that float in between

  /// A sensor that measures every surface in its range exactly.
  static StereoSensor ideal();

  /// @throws Error bad_input, `where` with the field's name as the place, for what is not finite,
  /// is negative, or is beyond its range.
  void check(std::string_view where) const;
  bool operator==(const StereoSensor&) const = default;
};

}  // namespace vantage
