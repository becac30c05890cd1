#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "simulator/simulated_scene.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/image.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// Brown–Conrady lens distortion in OpenCV's form and order.
struct Distortion {
  double k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0;
  bool none() const { return k1 == 0 && k2 == 0 && p1 == 0 && p2 == 0 && k3 == 0; }
  bool operator==(const Distortion&) const = default;
};

/// The light of the cell: a rectangular lamp over it, and a sky that comes from everywhere.
struct Lighting {
  Eigen::Vector3f lamp_centre_m = {-0.5f, -0.7f, 1.6f};
  float lamp_side_m = 0.8f;  ///< it is square, and faces `lamp_target_m`
  Eigen::Vector3f lamp_target_m = {0, 0, 0};
  float lamp_share = 0.65f;  ///< of the light on a surface at the target that faces the lamp; the
                             ///< sky's is the rest
  float sky_reach_m = 0.6f;  ///< what is farther away takes no light of the sky
  Eigen::Vector3f background = {0.90f, 0.91f, 0.93f};  ///< sRGB; what rays that meet nothing see
};

/// How a colour camera sees. Every effect can be switched off by its zero.
struct ColorSensor {
  int samples_per_pixel = 16;
  Distortion distortion = {};
  double vignetting = 0;  ///< 0: none; 1: the cos⁴ law in full
  double read_noise = 0;  ///< standard deviation of the linear signal, full scale = 1
  double shot_noise = 0;  ///< variance per unit of linear signal, full scale = 1
};

/// What the camera photographs: direct light of the lamp with soft shadows, skylight with ambient
/// occlusion, textures, box-filtered over each pixel's square. No motion blur: nothing moves.
///
/// Samples hash (seed, pixel, sample): the same call gives the same bytes at any number of threads.
/// The camera's depth range is ignored. Runs in the caller's task arena.
/// @returns nothing if `stop` asked to stop.
/// @throws Error bad_input for samples outside 1 to 4096, or a distortion that cannot be undone
/// inside the image (it folds over).
std::optional<ColorImage> simulate_color(const SimulatedScene& scene, const Lighting& lighting,
                                         const PinholeCamera& camera, const ColorSensor& sensor,
                                         std::uint64_t seed, const StopToken& stop = {});

}  // namespace vantage
