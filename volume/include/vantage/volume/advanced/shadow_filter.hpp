#pragma once

#include <memory>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/triangle_mesh.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/state_grid.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

// Filters for false shadow: what a depth sensor's noise leaves unseen along the floor and along the
// walls of objects (thesis 7.4, figure 7.10). Shadow that they remove becomes free; all else stays,
// revealed voxels too. Best by far is an opening of about a centimetre, after visibility meshes
// that were moved back by 3 σ; what is left has no small regions (`vantage evaluate
// shadow-filters`, the scenes of the README). They run in the caller's task arena; the result is
// the same at any number of threads.

/// The morphological opening of the shadow by a cube of (2 radius + 1)³ voxels: what no such cube
/// of shadow alone fits around goes. Around the grid there is no shadow, so that a layer on the
/// floor is as thin as it looks.
/// @throws Error bad_input unless 0 <= radius_voxels <= 64.
VANTAGE_API std::shared_ptr<const StateGrid> morphological_open(const StateGrid& grid,
                                                                int radius_voxels);

/// The radius that opens by cubes of an edge, as nearly as voxels allow: not larger than it.
/// @throws Error bad_input unless `edge_m` is finite and not negative.
VANTAGE_API int opening_radius(const StateGrid& grid, double edge_m);

/// The shadow that planning uses: if the options say so, the grid without the thin shadow of noise,
/// with its volume in the report; else the grid itself.
/// @param grid a classification of `world` by `options`; never null.
/// @throws Error bad_input as `VolumeOptions::check` does.
VANTAGE_API std::shared_ptr<const StateGrid> without_false_shadow(
    std::shared_ptr<const StateGrid> grid, const WorldModel& world, const VolumeOptions& options);

/// A closed mesh that looks outwards, world frame, around the shadow and the voxels next to it,
/// also those beyond the grid's box: with it as its shell, a `UnobservedSpace` has what a filter
/// left of the unseen, up to the very surfaces that were measured.
VANTAGE_API TriangleMesh shell_around_shadow(const StateGrid& grid);

/// Removes the regions of shadow (`ShadowRegions`) that are smaller than `min_m3`.
/// @throws Error bad_input unless `min_m3` is finite and not negative.
VANTAGE_API std::shared_ptr<const StateGrid> remove_small_components(const StateGrid& grid,
                                                                     double min_m3);

}  // namespace vantage
