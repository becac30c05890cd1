#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/image.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// How an object looks: matt, lit from both sides.
struct Material {
  Eigen::Vector3f color = {0.8f, 0.8f, 0.8f};  ///< sRGB, 0 to 1

  /// Darker lines on planes that are `line_spacing_m` apart along each world axis, one of them
  /// through `line_origin`: they make single voxels visible. 0: none.
  float line_spacing_m = 0;
  float line_width_m = 0;
  float line_shade = 0.5f;  ///< brightness of the lines, as a part of the faces'
  Eigen::Vector3f line_origin = Eigen::Vector3f::Zero();

  /// The object dissolves into the background between these distances from `fade_centre`.
  float fade_from_m = std::numeric_limits<float>::infinity();
  float fade_to_m = std::numeric_limits<float>::infinity();
  Eigen::Vector3f fade_centre = Eigen::Vector3f::Zero();
};

/// Light and effort of a picture.
struct PictureOptions {
  /// Of a pixel that shows an edge or the border of a shadow; each takes a ray to the sky and one
  /// to the sun.
  int samples_per_pixel = 16;
  /// Of all other pixels, whose light is the mean of their neighbours' on the same surface. As many
  /// as `samples_per_pixel` or more: every pixel takes all of them, and none looks at its
  /// neighbours.
  int first_samples = 4;
  Eigen::Vector3f to_sun = {0.35f, -0.5f, 0.8f};        ///< of any length
  float sun_radius = 0.06f;                             ///< softness of the shadows' edges, radians
  float sky_reach_m = 0.6f;                             ///< what is farther away takes no skylight
  Eigen::Vector3f background = {0.98f, 0.98f, 0.985f};  ///< sRGB
};

/// Draws a scene with sun, soft shadows, ambient occlusion and anti-aliasing. The camera's depth
/// range is ignored.
///
/// Sampling is adaptive: a few samples everywhere, more where they differ from each other or from a
/// neighbour's. What a sample does follows from its number and its pixel's place alone, and the
/// same call gives the same bytes at any number of threads. Runs in the caller's task arena.
/// @param materials one for each object of the scene.
/// @param stop advanced by `picture_steps`; to expect them is up to the caller, who may draw
/// several pictures.
/// @returns nothing if `stop` asked to stop.
/// @throws Error bad_input for another number of materials, and samples outside 1 to 1024.
VANTAGE_API std::optional<ColorImage> render_picture(const Scene& scene,
                                                     std::span<const Material> materials,
                                                     const PinholeCamera& camera,
                                                     const PictureOptions& options = {},
                                                     const StopToken& stop = {});

/// How many steps drawing an image of this size is.
VANTAGE_API std::uint64_t picture_steps(int width, int height);

}  // namespace vantage
