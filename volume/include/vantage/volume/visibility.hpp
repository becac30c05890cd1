#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "vantage/raycore/api.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/depth_image.hpp"
#include "vantage/raycore/depth_lattice.hpp"
#include "vantage/raycore/triangle_mesh.hpp"
#include "vantage/volume/grid_geometry.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

/// What becomes of pixels without a depth.
enum class DepthHoles {
  fill,     ///< filled from the depths around them (thesis 7.4.2), where those are near enough
  unknown,  ///< nothing was measured there, so that nothing is free
};

/// How a depth image becomes a visibility mesh.
struct VisibilityOptions {
  int step_px = 8;  ///< every so many pixels a vertex; 1: all of them
  DepthHoles holes = DepthHoles::fill;
  int fill_reach_px = 24;    ///< no depth is filled in further than this from a measured one
  double offset_sigmas = 3;  ///< the surface moves back by so many σ(z): what noise makes is gone
  StereoNoise noise = {};

  /// @throws Error bad_input unless 1 <= step_px <= 64, 0 <= fill_reach_px <= 16384, and the offset
  /// is finite and not negative, and as `VolumeOptions::check` for the noise.
  VANTAGE_API void check() const;
  bool operator==(const VisibilityOptions&) const = default;
};

/// The visibility mesh of a depth image, of the part of it that shows the work area.
/// @returns nothing if the camera does not have the work area in its image, or measured nothing
/// there.
/// @throws Error bad_input as `VisibilityOptions::check` does.
VANTAGE_API std::optional<DepthLattice> visibility_lattice(const PosedDepth& image,
                                                           const Box& work_area,
                                                           const VisibilityOptions& options = {});

}  // namespace vantage
