#include "classify/fuse_cameras.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include "classify/anti_alias.hpp"
#include "grid/state_grid_impl.hpp"

namespace vantage::volume::detail {
namespace {

/// The voxels of a grid by what became of them. Disjoint but for `measured`, part of `occupied`,
/// and `unmeasured` and `outside`, parts of `shadow`.
struct States {
  BlockSet occupied, measured, shadow, unmeasured, outside, conflict;

  explicit States(const BlockLayout& layout)
      : occupied(layout),
        measured(layout),
        shadow(layout),
        unmeasured(layout),
        outside(layout),
        conflict(layout) {}
};

template <class Visit>
void for_each_block(const BlockLayout& layout, const Visit& visit) {
  tbb::parallel_for(std::size_t(0), layout.chunk_count(), [&](std::size_t chunk) {
    layout.blocks_in_chunk(chunk).for_each(
        [&](const Eigen::Vector3i& block) { visit(layout.index(block)); });
  });
}

void decide_block(std::size_t block, const KnownObjects& known,
                  std::span<const CameraEvidence> cameras, States& states) {
  const BlockBits inside = states.shadow.layout().inside(block);
  const BlockBits solid = known.solid.bits(block);
  BlockBits covered, hidden, free, surface, through_solid;
  for (const CameraEvidence& camera : cameras) {
    const BlockBits in_view = camera.sight.covered.bits(block);
    BlockBits sees = camera.sight.clear.bits(block);
    covered |= in_view;
    BlockBits without_answer = sees;  // nothing known is in the way, and nothing measured
    if (camera.depth) {
      const BlockBits through = camera.depth->through.bits(block);
      sees &= through;
      surface |= camera.depth->surface.bits(block);
      through_solid |= through & solid;
      without_answer &= camera.depth->unknown.bits(block);
    }
    hidden |= in_view & ~without_answer;
    free |= sees;
  }
  const BlockBits measured = surface & ~solid & ~free;
  const BlockBits shadow = inside & ~solid & ~free & ~measured;
  states.occupied.set(block, solid | measured);
  states.measured.set(block, measured);
  states.shadow.set(block, shadow);
  states.unmeasured.set(block, shadow & covered & ~hidden);
  states.outside.set(block, shadow & ~covered);
  states.conflict.set(block, through_solid);
}

BlockSet find_aliased(const BlockSet& shadow) {
  BlockSet aliased(shadow.layout());
  for_each_block(shadow.layout(),
                 [&](std::size_t block) { aliased.set(block, aliased_shadow(shadow, block)); });
  return aliased;
}

BlockSet without(const BlockSet& set, const BlockSet& removed) {
  BlockSet rest(set.layout());
  for_each_block(set.layout(), [&](std::size_t block) {
    rest.set(block, set.bits(block) & ~removed.bits(block));
  });
  return rest;
}

std::uint64_t count(const BlockSet& set) {
  std::uint64_t sum = 0;
  for (std::size_t block = 0; block < set.layout().block_count(); ++block) {
    if (!set.none(block)) sum += set.bits(block).count();
  }
  return sum;
}

/// Whole blocks become tiles, which cost a bit each.
void fill_tree(const BlockSet& set, openvdb::MaskTree& tree) {
  const BlockLayout& layout = set.layout();
  layout.blocks().for_each([&](const Eigen::Vector3i& block) {
    const std::size_t index = layout.index(block);
    if (set.none(index)) return;
    const openvdb::Coord origin = to_coord(kBlockSide * block);
    const BlockBits bits = set.bits(index);
    if (bits == BlockBits::all()) return tree.addTile(1, origin, true, true);
    auto leaf = std::make_unique<openvdb::MaskTree::LeafNodeType>(origin, false);
    bits.for_each([&](int offset) { leaf->setValueOn(openvdb::Index(offset)); });
    tree.addLeaf(leaf.release());
  });
}

/// Objects with voxels in conflict, but for what noise explains: single voxels and thin layers
/// under an object's surface. More than that is a voxel with five of its six neighbours, or a fifth
/// of the object.
std::vector<ObjectConflict> conflicts(const KnownObjects& known, const BlockSet& conflict) {
  std::vector<ObjectConflict> found;
  if (count(conflict) == 0) return found;
  const BlockSet core = without(conflict, find_aliased(conflict));
  for (std::size_t i = 0; i < known.voxels.size(); ++i) {
    ObjectConflict object{known.names[i], 0, 0};
    bool thick = false;
    for (const ObjectVoxels::Block& block : known.voxels[i].blocks) {
      thick = thick || !(block.bits & core.bits(block.block)).none();
      object.voxels += (block.bits & conflict.bits(block.block)).count();
      object.of_voxels += block.bits.count();
    }
    const bool much = object.voxels > 0 && 5 * object.voxels >= object.of_voxels;
    if (thick || much) found.push_back(std::move(object));
  }
  return found;
}

}  // namespace

std::shared_ptr<const StateGrid> combine(const GridGeometry& geometry, const KnownObjects& known,
                                         std::span<const CameraEvidence> cameras, bool anti_alias) {
  States states{BlockLayout(geometry)};
  for_each_block(states.shadow.layout(),
                 [&](std::size_t block) { decide_block(block, known, cameras, states); });
  const BlockSet aliased = find_aliased(states.shadow);
  if (anti_alias) {
    states.shadow = without(states.shadow, aliased);
    states.unmeasured = without(states.unmeasured, aliased);
    states.outside = without(states.outside, aliased);
  }
  auto impl = std::make_unique<StateGridImpl>(geometry);
  tbb::parallel_invoke([&] { fill_tree(states.occupied, impl->occupied); },
                       [&] { fill_tree(states.measured, impl->measured); },
                       [&] { fill_tree(states.shadow, impl->shadow); },
                       [&] { fill_tree(states.unmeasured, impl->unmeasured); },
                       [&] { fill_tree(states.outside, impl->outside); });
  const std::uint64_t occupied = count(states.occupied), shadow = count(states.shadow);
  impl->counts = {geometry.voxel_count() - occupied - shadow, occupied, shadow, 0};
  impl->report.unmeasured_shadow = count(states.unmeasured);
  impl->report.outside_shadow = count(states.outside);
  impl->report.aliased_shadow = count(aliased);
  impl->report.conflicts = conflicts(known, states.conflict);
  impl->report.warnings = known.warnings;
  return std::make_shared<const StateGrid>(std::move(impl));
}

}  // namespace vantage::volume::detail
