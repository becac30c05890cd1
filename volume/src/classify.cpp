#include "vantage/volume/classify.hpp"

#include <tbb/parallel_for.h>

#include <optional>

#include "blocks.hpp"
#include "camera_view.hpp"
#include "solid_voxels.hpp"
#include "state_grid_impl.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/scene_builder.hpp"

namespace vantage {
namespace detail {
namespace {

using StateLeaf = openvdb::Int32Tree::LeafNodeType;
using MaskLeaf = openvdb::MaskTree::LeafNodeType;

struct BlockLeaves {
  std::unique_ptr<StateLeaf> states;
  std::unique_ptr<MaskLeaf> measured;
  std::array<std::uint64_t, 4> counts{};
};

void check(const WorldModel& world) {
  for (const auto* list : {&world.objects, &world.static_structures}) {
    for (const KnownObject& object : *list) {
      if (object.mesh == nullptr) throw bad_input("object " + object.name, "it has no mesh");
    }
  }
  for (const Observer& camera : world.cameras) {
    if (camera.depth != nullptr) PosedDepth(camera.camera, camera.depth, "camera " + camera.name);
  }
}

template <class Visit>
void for_each_object(const WorldModel& world, const Visit& visit) {
  for (const KnownObject& object : world.objects) visit(object);
  for (const KnownObject& object : world.static_structures) visit(object);
}

void add_known_objects(const WorldModel& world, SceneBuilder& builder) {
  for_each_object(world, [&](const KnownObject& object) {
    builder.add_mesh(object.mesh->transformed(object.T_world_object));
  });
}

BlockLeaves decide_block(const BlockLayout& layout, std::size_t block, const Evidence& evidence) {
  BlockLeaves leaves;
  const openvdb::Coord origin = to_coord(layout.first_voxel(block));
  layout.for_each_voxel(block, [&](const Eigen::Vector3i&, int offset) {
    const bool solid = evidence.solid.test(block, offset);
    const bool free = !solid && evidence.free.test(block, offset);
    const bool measured = !solid && !free && evidence.surface.test(block, offset);
    const VoxelState state = free                ? VoxelState::free
                             : solid || measured ? VoxelState::occupied
                                                 : VoxelState::shadow;
    ++leaves.counts[std::size_t(state)];
    if (free) return;
    if (!leaves.states) leaves.states = std::make_unique<StateLeaf>(origin, 0);
    leaves.states->setValueOn(openvdb::Index(offset), std::int32_t(state));
    if (!measured) return;
    if (!leaves.measured) leaves.measured = std::make_unique<MaskLeaf>(origin, false);
    leaves.measured->setValueOn(openvdb::Index(offset));
  });
  return leaves;
}

std::shared_ptr<const StateGrid> build_grid(const GridGeometry& geometry, const BlockLayout& layout,
                                            const Evidence& evidence) {
  std::vector<BlockLeaves> blocks(layout.count());
  tbb::parallel_for(std::size_t(0), blocks.size(), [&](std::size_t block) {
    blocks[block] = decide_block(layout, block, evidence);
  });
  auto impl = std::make_unique<StateGridImpl>(geometry);
  for (BlockLeaves& block : blocks) {  // the trees take over the leaves
    if (block.states) impl->states.addLeaf(block.states.release());
    if (block.measured) impl->measured.addLeaf(block.measured.release());
    for (std::size_t s = 0; s < block.counts.size(); ++s) impl->counts[s] += block.counts[s];
  }
  return std::make_shared<const StateGrid>(std::move(impl));
}

}  // namespace
}  // namespace detail

std::shared_ptr<const StateGrid> classify(const WorldModel& world, const GridGeometry& geometry,
                                          const StopToken& stop) {
  detail::check(world);
  const detail::BlockLayout layout(geometry);
  detail::Evidence evidence(layout);
  stop.expect(world.cameras.size() * layout.count());
  detail::for_each_object(world, [&](const KnownObject& object) {
    if (!stop.stop_requested()) detail::add_solid_voxels(object, geometry, evidence.solid);
  });
  const std::shared_ptr<const Scene> known = known_scene(world);
  const Scene* occluders = known->triangle_count() > 0 ? known.get() : nullptr;
  for (const Observer& observer : world.cameras) {
    if (stop.stop_requested()) break;
    const detail::CameraView view(observer, geometry, layout, occluders);
    tbb::parallel_for(std::size_t(0), layout.count(), [&](std::size_t block) {
      if (stop.stop_requested()) return;
      view.add_block(block, evidence);
      stop.advance(1);
    });
  }
  if (stop.stop_requested()) return nullptr;
  return detail::build_grid(geometry, layout, evidence);
}

std::shared_ptr<const Scene> known_scene(const WorldModel& world) {
  SceneBuilder builder;
  detail::add_known_objects(world, builder);
  return builder.build();
}

std::shared_ptr<const Scene> occluder_scene(const WorldModel& world, const StateGrid& grid) {
  SceneBuilder builder;
  detail::add_known_objects(world, builder);
  builder.add_mesh(grid.measured_faces());
  return builder.build();
}

}  // namespace vantage
