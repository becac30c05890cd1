#pragma once

#include <memory>

#include "vantage/raycore/api.hpp"
#include "vantage/raycore/scene.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/grid_geometry.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage {

/// Sorts every voxel of the work area into free, occupied and shadow (thesis 7.2.2 and 7.2.3, with
/// depth images beside the known objects).
///
/// A voxel is, in this order,
/// 1. occupied if its centre is inside a known object or a static structure;
/// 2. free if some camera sees its centre: inside the image and the depth range, no known object in
///    between, and, for a camera with a depth image, more than half a voxel in front of the depth
///    measured at the nearest pixel, without a measured point inside the voxel;
/// 3. occupied if it is at a surface that some depth image shows: a measured point lies in it, or
///    its centre is within half a voxel of the measured depth;
/// 4. shadow otherwise. Unknown depth proves nothing.
///
/// Runs in the caller's task arena; the result is the same at any number of threads.
/// @returns null if `stop` asked to stop: half a classification says nothing.
/// @throws Error bad_input if a depth image does not fit its camera, or if an object has no mesh.
VANTAGE_API std::shared_ptr<const StateGrid> classify(const WorldModel& world,
                                                      const GridGeometry& geometry,
                                                      const StopToken& stop = {});

/// The exact triangles of all known objects and static structures.
VANTAGE_API std::shared_ptr<const Scene> known_scene(const WorldModel& world);

/// Everything that hides something from a new view: the known objects' triangles and the faces of
/// the measured voxels.
VANTAGE_API std::shared_ptr<const Scene> occluder_scene(const WorldModel& world,
                                                        const StateGrid& grid);

}  // namespace vantage
