#pragma once

#include <optional>

#include "vantage/raycore/advanced/visibility_mesh.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/depth_image.hpp"
#include "vantage/raycore/export.hpp"
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
///
/// Vertices are at every `step_px`-th pixel of the rectangle of pixels whose rays can meet the work
/// area, and at its last row and column: at the image's border the mesh ends at the outermost
/// pixels' centres. A vertex has its own pixel's depth; what is smaller than a step may be missed.
///
/// A hole is filled linearly in inverse depth, in which surfaces are planes: between the nearest
/// depths to both sides, along its row and its column, weighted by nearness; where no two sides are
/// within reach, with the continuation from one side, but never farther than that side's depth: it
/// would be free space that nobody measured.
///
/// The surface moves away from the camera by `offset_sigmas` times what the noise is in inverse
/// depth: in depth that is σ(z), to first order. What is measured too near by chance, before the
/// floor and the walls of objects, is then no unseen sliver. The default is where more begins to
/// cost hidden volume and takes hardly more slivers away (`vantage evaluate shadow-filters`).
/// @returns nothing if the camera does not have the work area in its image, or measured nothing
/// there.
/// @throws Error bad_input as `VisibilityOptions::check` does.
VANTAGE_API std::optional<VisibilityMesh> visibility_lattice(const PosedDepth& image,
                                                             const Box& work_area,
                                                             const VisibilityOptions& options = {});

}  // namespace vantage
