#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <string>
#include <vector>

#include "grid/grid_frame.hpp"
#include "objects/object_voxels.hpp"
#include "objects/occluders.hpp"
#include "vantage/raycore/detail/box_projector.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage::volume::detail {

/// What a known object fills where it stands, and where its surface is.
struct ObjectBody {
  ObjectVoxels voxels;
  SurfaceOctants surface;
  Eigen::AlignedBox3d bounds;  ///< of the mesh, and of every voxel that it touches
};

/// The known objects and static structures of a world, as voxels and as surfaces.
struct KnownObjects {
  std::vector<std::string> names;
  std::vector<std::shared_ptr<const ObjectBody>> bodies;  ///< of each object
  BlockSet solid;                                         ///< of all of them
  std::vector<std::uint8_t> surface_octants;              ///< of all, by block
  std::vector<PlacedMesh> meshes;
  std::vector<std::string> warnings;

  /// Voxelises. If `stop` asks to stop, what is there is incomplete.
  /// @param before complete ones in the same frame: an object that has not moved is not voxelised
  /// again. Null: none.
  KnownObjects(const WorldModel& world, const GridFrame& frame, const Pose& T_grid_world,
               const StopToken& stop, const KnownObjects* before = nullptr);
};

/// The boxes around all that hides something else in one of them than in the other.
std::vector<Extent> changed_extents(const KnownObjects& before, const KnownObjects& after);

/// @throws Error bad_input if an object or a static structure has no mesh.
void check_meshes(const WorldModel& world);

/// Calls `visit` for the objects, then for the static structures.
template <class Visit>
void for_each_known(const WorldModel& world, const Visit& visit) {
  for (const KnownObject& object : world.objects) visit(object);
  for (const KnownObject& object : world.static_structures) visit(object);
}

}  // namespace vantage::volume::detail
