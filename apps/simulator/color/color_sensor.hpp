#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "simulator/scene/simulated_scene.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/image.hpp"
#include "vantage/raycore/lens.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// The light of the cell: a square lamp over it, and a sky that comes from everywhere.
///
/// A matt surface sends back, of each colour, its share of
///   lamp: ∫ cos·cos'/r² over the lamp, as if nothing stood between, times the visible part of the
///         lamp's area – equal to the usual integral where all or nothing of the lamp is visible,
///         and without noise there;
///   sky:  the part of the hemisphere, weighted by the cosine, that nothing obstructs within
///         `sky_reach_m`; what is obstructed counts `bounce` of it.
struct Lighting {
  Eigen::Vector3f lamp_centre_m = {-0.7f, -0.8f, 1.4f};
  float lamp_side_m = 0.6f;  ///< shines on one side only, which faces `lamp_target_m`
  Eigen::Vector3f lamp_target_m = {0, 0, 0};
  float exposure = 0.85f;    ///< linear signal, full scale 1, of a perfectly white surface at the
                             ///< target that faces the lamp, with nothing around
  float lamp_share = 0.55f;  ///< part of that light that the lamp gives; the sky's is the rest
  float sky_reach_m = 0.6f;  ///< what is farther away takes no light of the sky
  float bounce = 0.5f;       ///< what things around throw back, as a part of the sky's light
  Eigen::Vector3f background = {0.90f, 0.91f, 0.93f};  ///< sRGB; what rays that meet nothing see
};

/// How a colour camera sees. Every effect can be switched off by its zero.
struct ColorSensor {
  int samples_per_pixel = 16;  ///< 1 to 4096
  Distortion distortion = {};
  double vignetting = 0;  ///< 0 to 1: the signal times 1 − (1 − cos⁴) · it; 1 is the cos⁴ law
  double read_noise = 0;  ///< 0 to 1: standard deviation of the linear signal, full scale = 1
  double shot_noise = 0;  ///< 0 to 1: variance per unit of linear signal, full scale = 1
};

/// What the camera photographs: direct light of the lamp with soft shadows, skylight with ambient
/// occlusion, textures (the nearest texel), box-filtered over each pixel's square. Noise is normal,
/// added to the linear signal of each channel; what is above 1 or below 0 is cut off. No motion
/// blur: nothing moves.
///
/// With distortion, pixels show what OpenCV's projectPoints puts there.
///
/// Samples hash (seed, pixel, sample): the same call gives the same bytes at any number of threads.
/// The camera's depth range is ignored. Runs in the caller's task arena; `stop` counts bands of
/// four rows.
/// @returns nothing if `stop` asked to stop. It is told of no progress: its owner counts
/// photographs.
/// @throws Error bad_input for a setting outside the range that is stated with it, a distortion
/// that cannot be undone inside the image (it folds over), a body's colour outside 0 to 1, and a
/// texture without texels or with coordinates that are not finite.
std::optional<ColorImage> simulate_color(const SimulatedScene& scene, const Lighting& lighting,
                                         const PinholeCamera& camera, const ColorSensor& sensor,
                                         std::uint64_t seed, const StopToken& stop = {});

}  // namespace vantage
