#include "vantage/volume/state_grid.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include "grid/openvdb.hpp"

#include <openvdb/tools/Prune.h>

#include "grid/mask_blocks.hpp"
#include "grid/state_grid_impl.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace volume::detail {
namespace {

/// For each block, how many voxels are on in the blocks before it; the last entry is the total.
std::vector<std::size_t> counts_before(const std::vector<MaskBlock>& blocks) {
  std::vector<std::size_t> before{0};
  before.reserve(blocks.size() + 1);
  for (const MaskBlock& block : blocks) {
    before.push_back(before.back() + std::size_t(block.mask ? block.mask->countOn() : 512));
  }
  return before;
}

Points centres_of(const openvdb::MaskTree& voxels, const GridGeometry& geometry) {
  const std::vector<MaskBlock> blocks = mask_blocks(voxels);
  const std::vector<std::size_t> before = counts_before(blocks);
  Points points(before.back());
  const auto fill = [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t b = range.begin(); b < range.end(); ++b) {
      std::size_t next = before[b];
      const Eigen::Vector3i first = to_voxel(blocks[b].origin);
      for_each_on(blocks[b].words(), [&](int x, int y, int z) {
        const Eigen::Vector3i voxel = first + Eigen::Vector3i(x, y, z);
        points.set(next++, geometry.centre(voxel).cast<float>());
      });
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks.size()), fill);
  return points;
}

void move_voxels(const openvdb::Coord& origin, const BlockWords& moved, openvdb::MaskTree& from,
                 openvdb::MaskTree& to) {
  auto* const source = from.touchLeaf(origin);
  BlockMask left = source->getValueMask();
  left -= mask_of(moved);
  source->setValueMask(left);
  auto* const target = to.touchLeaf(origin);
  target->setValueMask(target->getValueMask() | mask_of(moved));
}

}  // namespace
}  // namespace volume::detail

StateGrid::StateGrid(std::unique_ptr<const volume::detail::StateGridImpl> impl)
    : impl_(std::move(impl)) {}
StateGrid::~StateGrid() = default;

const GridGeometry& StateGrid::geometry() const noexcept {
  return impl_->geometry;
}

VoxelState StateGrid::at(const Eigen::Vector3i& voxel) const {
  const openvdb::Coord place = volume::detail::to_coord(voxel);
  if (impl_->occupied.isValueOn(place)) return VoxelState::occupied;
  if (impl_->shadow.isValueOn(place)) return VoxelState::shadow;
  if (impl_->revealed.isValueOn(place)) return VoxelState::revealed;
  return VoxelState::free;
}

bool StateGrid::measured(const Eigen::Vector3i& voxel) const {
  return impl_->measured.isValueOn(volume::detail::to_coord(voxel));
}

std::optional<ShadowCause> StateGrid::shadow_cause(const Eigen::Vector3i& voxel) const {
  const VoxelState state = at(voxel);
  if (state != VoxelState::shadow && state != VoxelState::revealed) return std::nullopt;
  const openvdb::Coord place = volume::detail::to_coord(voxel);
  if (impl_->outside.isValueOn(place)) return ShadowCause::outside;
  return impl_->unmeasured.isValueOn(place) ? ShadowCause::unmeasured : ShadowCause::hidden;
}

std::uint64_t StateGrid::count(VoxelState state) const noexcept {
  return impl_->counts[std::size_t(state)];
}

const VolumeReport& StateGrid::report() const noexcept {
  return impl_->report;
}

Points StateGrid::centres(VoxelState state) const {
  return volume::detail::with_voxels(*impl_, state, [&](const openvdb::MaskTree& voxels) {
    return volume::detail::centres_of(voxels, geometry());
  });
}

std::shared_ptr<const StateGrid> StateGrid::with_revealed(
    std::span<const std::uint8_t> seen) const {
  if (seen.size() != count(VoxelState::shadow)) {
    throw bad_input("revealed voxels", fmt::format("there are {} flags for {} shadow voxels",
                                                   seen.size(), count(VoxelState::shadow)));
  }
  auto impl = std::make_unique<volume::detail::StateGridImpl>(*impl_);
  std::size_t next = 0;
  for (const volume::detail::MaskBlock& block : volume::detail::mask_blocks(impl_->shadow)) {
    volume::detail::BlockWords revealed{};
    volume::detail::for_each_on(block.words(), [&](int x, int y, int z) {
      const bool on = seen[next++] != 0;
      revealed[std::size_t(x)] |= std::uint64_t(on) << (8 * y + z);
    });
    const std::uint64_t count = std::uint64_t(volume::detail::count_on(revealed));
    if (count == 0) continue;
    volume::detail::move_voxels(block.origin, revealed, impl->shadow, impl->revealed);
    impl->counts[std::size_t(VoxelState::shadow)] -= count;
    impl->counts[std::size_t(VoxelState::revealed)] += count;
  }
  openvdb::tools::prune(impl->shadow);
  openvdb::tools::prune(impl->revealed);
  return std::make_shared<const StateGrid>(std::move(impl));
}

}  // namespace vantage
