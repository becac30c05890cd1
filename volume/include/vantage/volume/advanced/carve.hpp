#pragma once

#include <memory>
#include <span>

#include "vantage/raycore/advanced/visibility_mesh.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/triangle_mesh.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/grid_geometry.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage {

/// Sorts every voxel by what depth lattices saw through, and nothing else: occupied if its centre
/// is inside an object or a static structure of `known`, as `classify` has it; free if a lattice
/// sees its centre, as `VisibilityMesh::sees` says but for rounding; shadow otherwise ("solid or
/// shadow", thesis 7.4.3), and `unseen` shadow in no lattice's rectangle of pixels. Objects that
/// lattices see through are in the report's conflicts.
///
/// Runs in the caller's task arena; the result is the same at any number of threads.
/// @param known its cameras play no part.
/// @returns null if `stop` asked to stop.
/// @throws Error bad_input as `VisibilityMesh::check` and `classify` do.
VANTAGE_API std::shared_ptr<const StateGrid> carve(std::span<const VisibilityMesh> lattices,
                                                   const GridGeometry& geometry,
                                                   const WorldModel& known,
                                                   const StopToken& stop = {});

/// The surface of the grid's box less what the lattices saw through, as a closed mesh that looks
/// outwards, to export and to view; world frame. It is where rays first meet what is unseen
/// (`UnobservedSpace`) to within a voxel's diagonal, and where it is smooth to a small part of a
/// voxel; edges are rounded by up to half a voxel, and what is thinner than a voxel may be missing.
/// A voxel's centre is inside the surface exactly if `carve` without known objects has it as
/// shadow.
///
/// Runs in the caller's task arena; the result is the same at any number of threads.
/// @throws Error bad_input as `VisibilityMesh::check` does.
VANTAGE_API TriangleMesh unseen_surface(std::span<const VisibilityMesh> lattices,
                                        const GridGeometry& geometry);

/// The same with what a filter for false shadow left: of the unseen, what is within
/// `shell_around_shadow(filtered)`, by the voxels of `filtered`. The surface is where rays first
/// meet what is unseen in a `UnobservedSpace` with that shell.
/// @param filtered what `carve` made of these lattices, then filtered (`morphological_open`).
/// @throws Error bad_input as above.
VANTAGE_API TriangleMesh unseen_surface(std::span<const VisibilityMesh> lattices,
                                        const StateGrid& filtered);

}  // namespace vantage
