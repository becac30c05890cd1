#pragma once

#include <memory>

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/grid_geometry.hpp"
#include "vantage/volume/state_grid.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

/// Sorts every voxel of the work area into free, occupied and shadow (thesis 7.2.2 to 7.2.4, with
/// depth images beside the known objects).
///
/// A voxel is, in this order,
/// 1. occupied if its centre is inside a known object or a static structure. A mesh that is not
///    closed has no inside: it occupies the voxels that its surface touches, and the grid's report
///    has a warning that names it;
/// 2. free if some camera sees its centre: inside the image and the depth range, nothing known in
///    between (`VolumeOptions::occluders` says what hides), and, for a camera with a depth image,
///    in front of the surface band around the depth measured at the nearest pixel, without a
///    measured point inside the voxel;
/// 3. occupied if its centre is in view of a camera whose depth image shows a surface there: a
///    measured point lies in the voxel, or its centre is inside the surface band;
/// 4. shadow otherwise. Unknown depth proves nothing.
///
/// Then, if it is on, anti-aliasing frees every shadow voxel that has fewer than 5 shadow voxels
/// among its 6 neighbours, all at once.
///
/// Runs in the caller's task arena; the result is the same at any number of threads, and does not
/// depend on where the work area lies in the world.
/// @returns null if `stop` asked to stop: half a classification says nothing.
/// @throws Error bad_input if the options are invalid, a depth image does not fit its camera, or an
/// object has no mesh.
VANTAGE_API std::shared_ptr<const StateGrid> classify(const WorldModel& world,
                                                      const GridGeometry& geometry,
                                                      const VolumeOptions& options = {},
                                                      const StopToken& stop = {});

/// The exact triangles of all known objects and static structures.
VANTAGE_API std::shared_ptr<const Scene> known_scene(const WorldModel& world);

/// Everything that hides something from a new view: the known objects' triangles, or in `voxels`
/// mode the faces of their voxels, and the faces of the measured voxels.
VANTAGE_API std::shared_ptr<const Scene> occluder_scene(const WorldModel& world,
                                                        const StateGrid& grid,
                                                        OccluderMode mode = OccluderMode::mesh);

/// Adds the objects of `occluder_scene` to a scene that is to have more in it.
VANTAGE_API void add_occluders(const WorldModel& world, const StateGrid& grid, OccluderMode mode,
                               SceneBuilder& builder);

}  // namespace vantage
