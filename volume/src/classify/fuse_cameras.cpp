#include "classify/fuse_cameras.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include "grid/openvdb.hpp"

#include <openvdb/tools/Prune.h>

#include <algorithm>

#include "classify/anti_alias.hpp"
#include "grid/mask_blocks.hpp"
#include "grid/state_grid_impl.hpp"

namespace vantage::volume::detail {
namespace {

/// Visits chunks in parallel, and in each the blocks for which `wanted` holds.
template <class Wanted, class Visit>
void for_each_block(const BlockLayout& layout, const Wanted& wanted, const Visit& visit) {
  tbb::parallel_for(std::size_t(0), layout.chunk_count(), [&](std::size_t chunk) {
    if (!wanted(chunk)) return;
    layout.blocks_in_chunk(chunk).for_each(
        [&](const Eigen::Vector3i& block) { visit(chunk, layout.index(block)); });
  });
}

BlockBits bits_before(openvdb::tree::ValueAccessor<openvdb::MaskTree>& tree,
                      const openvdb::Coord& origin) {
  BlockBits bits;
  if (const auto* leaf = tree.probeConstLeaf(origin)) {
    bits.words = words_of(leaf->getValueMask());
  } else if (tree.isValueOn(origin)) {
    bits = BlockBits::all();
  }
  return bits;
}

/// Whole blocks become tiles, which cost a bit each.
void put(openvdb::tree::ValueAccessor<openvdb::MaskTree>& tree, const openvdb::Coord& origin,
         const BlockBits& bits) {
  if (bits.none() || bits == BlockBits::all()) {
    return tree.addTile(1, origin, !bits.none(), !bits.none());
  }
  auto leaf = std::make_unique<openvdb::MaskTree::LeafNodeType>(origin, false);
  leaf->setValueMask(mask_of(bits.words));
  tree.addLeaf(leaf.release());
}

/// Brings the marked blocks of a tree up to date. The tree is then as if it had been filled from
/// scratch.
/// @returns how many voxels more it has.
template <class BitsOf>
std::int64_t update_tree(const BlockLayout& layout, const std::vector<std::uint8_t>& marked,
                         const BitsOf& bits_of, openvdb::MaskTree& tree) {
  openvdb::tree::ValueAccessor<openvdb::MaskTree> at(tree);
  const bool filled = !tree.empty();
  std::int64_t more = 0;
  bool emptied = false;
  for (std::size_t block = 0; block < marked.size(); ++block) {
    if (marked[block] == 0) continue;
    const BlockBits after = bits_of(block);
    if (!filled && after.none()) continue;
    const openvdb::Coord origin = to_coord(kBlockSide * layout.block_at(block));
    const BlockBits before = filled ? bits_before(at, origin) : BlockBits{};
    if (before == after) continue;
    more += std::int64_t(after.count()) - std::int64_t(before.count());
    emptied = emptied || after.none();
    put(at, origin, after);
  }
  if (emptied) openvdb::tools::pruneInactive(tree);
  return more;
}

/// Objects with voxels in conflict, but for what noise explains: single voxels and thin layers
/// under an object's surface. More than that is a voxel with five of its six neighbours, or a fifth
/// of the object.
std::vector<ObjectConflict> conflicts(const KnownObjects& known, const BlockSet& conflict) {
  std::vector<ObjectConflict> found;
  for (std::size_t i = 0; i < known.bodies.size(); ++i) {
    ObjectConflict object{known.names[i], 0, 0};
    bool thick = false;
    for (const ObjectVoxels::Block& block : known.bodies[i]->voxels.blocks) {
      const BlockBits through = block.bits & conflict.bits(block.block);
      object.voxels += through.count();
      object.of_voxels += block.bits.count();
      thick = thick || !(through & ~aliased_shadow(conflict, block.block)).none();
    }
    const bool much = object.voxels > 0 && 5 * object.voxels >= object.of_voxels;
    if (thick || much) found.push_back(std::move(object));
  }
  return found;
}

std::uint64_t count(const BlockSet& set) {
  std::uint64_t sum = 0;
  for (std::size_t block = 0; block < set.layout().block_count(); ++block) {
    if (!set.none(block)) sum += set.bits(block).count();
  }
  return sum;
}

}  // namespace

Fusion::Fusion(const GridGeometry& geometry)
    : geometry_(geometry),
      states_(BlockLayout(geometry)),
      blocks_(states_.shadow.layout().block_count(), 1),
      chunks_(states_.shadow.layout().chunk_count(), 1),
      shadow_changed_(blocks_.size()) {}

void Fusion::mark(std::size_t chunk, std::size_t block) {
  blocks_[block] = chunks_[chunk] = 1;
}

void Fusion::changed(const BlockSet* before, const BlockSet* after) {
  if (last_ == nullptr || before == after) return;  // all is marked, or nothing to mark
  for_each_block(
      states_.shadow.layout(), [](std::size_t) { return true; },
      [&](std::size_t chunk, std::size_t block) {
        const bool same = before == nullptr  ? after->none(block)
                          : after == nullptr ? before->none(block)
                                             : before->same(block, *after);
        if (!same) mark(chunk, block);
      });
}

void Fusion::changed(const CameraVisibility* before, const CameraVisibility* after) {
  changed(before ? &before->covered : nullptr, after ? &after->covered : nullptr);
  changed(before ? &before->clear : nullptr, after ? &after->clear : nullptr);
}

void Fusion::changed(const DepthEvidence* before, const DepthEvidence* after,
                     const CameraVisibility& sight) {
  changed(before ? &before->through : nullptr, after ? &after->through : nullptr);
  changed(before ? &before->surface : nullptr, after ? &after->surface : nullptr);
  changed(before ? &before->unknown : nullptr, after ? &after->unknown : nullptr);
  // Without a depth image, all that is clear is free; with one, only what it sees through.
  if ((before == nullptr) != (after == nullptr)) changed(nullptr, &sight.clear);
}

void Fusion::changed(const CameraEvidence* before, const CameraEvidence* after) {
  changed(before ? &before->sight : nullptr, after ? &after->sight : nullptr);
  const auto depth = [](const CameraEvidence* c) { return c && c->depth ? &*c->depth : nullptr; };
  changed(depth(before), depth(after), after ? after->sight : before->sight);
}

void Fusion::changed(const KnownObjects& before, const KnownObjects& after) {
  changed(&before.solid, &after.solid);
  report_changed_ = true;
}

void Fusion::decide(std::size_t block, const KnownObjects& known,
                    std::span<const CameraEvidence* const> cameras) {
  const BlockBits inside = states_.shadow.layout().inside(block);
  const BlockBits solid = known.solid.bits(block);
  BlockBits covered, hidden, free, surface, through_solid;
  for (const CameraEvidence* camera : cameras) {
    const BlockBits in_view = camera->sight.covered.bits(block);
    BlockBits sees = camera->sight.clear.bits(block);
    covered |= in_view;
    BlockBits without_answer = sees;  // nothing known is in the way, and nothing measured
    if (camera->depth) {
      const BlockBits through = camera->depth->through.bits(block);
      sees &= through;
      surface |= camera->depth->surface.bits(block);
      through_solid |= through & solid;
      without_answer &= camera->depth->unknown.bits(block);
    }
    hidden |= in_view & ~without_answer;
    free |= sees;
  }
  const BlockBits measured = surface & ~solid & ~free;
  const BlockBits shadow = inside & ~solid & ~free & ~measured;
  shadow_changed_[block] = std::uint8_t(!(states_.shadow.bits(block) == shadow));
  states_.occupied.set(block, solid | measured);
  states_.measured.set(block, measured);
  states_.shadow.set(block, shadow);
  states_.unmeasured.set(block, shadow & covered & ~hidden);
  states_.outside.set(block, shadow & ~covered);
  states_.conflict.set(block, through_solid);
}

void Fusion::decide_marked(const KnownObjects& known,
                           std::span<const CameraEvidence* const> cameras) {
  for_each_block(
      states_.shadow.layout(), [&](std::size_t chunk) { return chunks_[chunk] != 0; },
      [&](std::size_t, std::size_t block) {
        if (blocks_[block] != 0) decide(block, known, cameras);
      });
}

/// Anti-aliasing looks at a voxel's neighbours.
void Fusion::mark_neighbours_of_shadow() {
  const BlockLayout& layout = states_.shadow.layout();
  const CellRange blocks = layout.blocks();
  for (std::size_t block = 0; block < blocks_.size(); ++block) {
    if (shadow_changed_[block] == 0) continue;
    const Eigen::Vector3i here = layout.block_at(block);
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        const Eigen::Vector3i there = here + step * Eigen::Vector3i::Unit(axis);
        if (there[axis] < 0 || there[axis] >= blocks.last[axis]) continue;
        const std::size_t neighbour = layout.index(there);
        mark(layout.chunk_of(neighbour), neighbour);
      }
    }
  }
}

void Fusion::find_aliased() {
  for_each_block(
      states_.shadow.layout(), [&](std::size_t chunk) { return chunks_[chunk] != 0; },
      [&](std::size_t, std::size_t block) {
        if (blocks_[block] != 0) states_.aliased.set(block, aliased_shadow(states_.shadow, block));
      });
}

void Fusion::update(bool anti_alias, StateGridImpl& grid) const {
  const auto update = [&](const BlockSet& states, openvdb::MaskTree& tree, bool filtered = false) {
    return std::uint64_t(update_tree(
        states.layout(), blocks_,
        [&](std::size_t block) {
          const BlockBits bits = states.bits(block);
          return filtered && anti_alias ? bits & ~states_.aliased.bits(block) : bits;
        },
        tree));
  };
  // All of these may also become less: modulo 2^64.
  tbb::parallel_invoke(
      [&] { grid.counts[1] += update(states_.occupied, grid.occupied); },
      [&] { update(states_.measured, grid.measured); },
      [&] { grid.counts[2] += update(states_.shadow, grid.shadow, true); },
      [&] { grid.report.unmeasured_shadow += update(states_.unmeasured, grid.unmeasured, true); },
      [&] { grid.report.outside_shadow += update(states_.outside, grid.outside, true); });
  grid.counts[0] = geometry_.voxel_count() - grid.counts[1] - grid.counts[2];
}

std::shared_ptr<const StateGrid> Fusion::grid(const KnownObjects& known,
                                              std::span<const CameraEvidence* const> cameras,
                                              bool anti_alias) {
  const bool none = std::find(chunks_.begin(), chunks_.end(), 1) == chunks_.end();
  if (none && !report_changed_) return last_;
  decide_marked(known, cameras);
  if (last_ != nullptr) mark_neighbours_of_shadow();
  find_aliased();
  auto impl = last_ != nullptr ? std::make_unique<StateGridImpl>(last_->impl())
                               : std::make_unique<StateGridImpl>(geometry_);
  update(anti_alias, *impl);
  impl->report.aliased_shadow = count(states_.aliased);
  impl->report.conflicts = conflicts(known, states_.conflict);
  impl->report.warnings = known.warnings;
  std::fill(blocks_.begin(), blocks_.end(), std::uint8_t(0));
  std::fill(chunks_.begin(), chunks_.end(), std::uint8_t(0));
  std::fill(shadow_changed_.begin(), shadow_changed_.end(), std::uint8_t(0));
  report_changed_ = false;
  last_ = std::make_shared<const StateGrid>(std::move(impl));
  return last_;
}

std::shared_ptr<const StateGrid> combine(const GridGeometry& geometry, const KnownObjects& known,
                                         std::span<const CameraEvidence> cameras, bool anti_alias) {
  std::vector<const CameraEvidence*> all;
  for (const CameraEvidence& camera : cameras) all.push_back(&camera);
  return Fusion(geometry).grid(known, all, anti_alias);
}

}  // namespace vantage::volume::detail
