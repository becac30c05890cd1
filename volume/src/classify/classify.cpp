#include "vantage/volume/advanced/classify.hpp"

#include "objects/known_objects.hpp"
#include "vantage/volume/advanced/voxel_surface.hpp"
#include "vantage/volume/shadow_volume.hpp"

namespace vantage {
namespace {

void add_known_objects(const WorldModel& world, SceneBuilder& builder) {
  volume::detail::for_each_known(world, [&](const KnownObject& object) {
    builder.add_mesh(object.mesh->transformed(object.T_world_object));
  });
}

}  // namespace

std::shared_ptr<const StateGrid> classify(const WorldModel& world, const GridGeometry& geometry,
                                          const VolumeOptions& options, const StopToken& stop) {
  return ShadowVolume(world, geometry, options, stop).grid();
}

std::shared_ptr<const Scene> known_scene(const WorldModel& world) {
  SceneBuilder builder;
  add_known_objects(world, builder);
  return builder.build();
}

void add_occluders(const WorldModel& world, const StateGrid& grid, OccluderMode mode,
                   SceneBuilder& builder) {
  if (mode == OccluderMode::mesh) {
    add_known_objects(world, builder);
    builder.add_mesh(measured_faces(grid));
  } else {
    builder.add_mesh(voxel_faces(grid, VoxelState::occupied));
  }
}

std::shared_ptr<const Scene> occluder_scene(const WorldModel& world, const StateGrid& grid,
                                            OccluderMode mode) {
  SceneBuilder builder;
  add_occluders(world, grid, mode, builder);
  return builder.build();
}

}  // namespace vantage
