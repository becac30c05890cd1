#pragma once

#include <optional>

#include "vantage/raycore/advanced/visibility_mesh.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/depth_image.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/volume/visibility_options.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

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
/// floor and the walls of objects, is then no unseen sliver. The default is where a larger offset
/// begins to cost hidden volume and removes few further slivers (`vantage evaluate
/// shadow-filters`).
/// @param noise of the camera's depths.
/// @returns nothing if the camera does not have the work area in its image, or measured nothing
/// there.
/// @throws Error bad_input as `VisibilityOptions::check` and `StereoNoise::check` do.
VANTAGE_API std::optional<VisibilityMesh> visibility_lattice(const PosedDepth& image,
                                                             const Box& work_area,
                                                             const StereoNoise& noise,
                                                             const VisibilityOptions& options = {});

}  // namespace vantage
