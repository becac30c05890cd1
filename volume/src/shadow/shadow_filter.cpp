#include "vantage/volume/advanced/shadow_filter.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include "grid/openvdb.hpp"

#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cmath>

#include "grid/mask_blocks.hpp"
#include "grid/state_grid_impl.hpp"
#include "shadow/shell_voxels.hpp"
#include "surface/voxel_faces.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/advanced/shadow_regions.hpp"

namespace vantage {
namespace {

namespace tools = openvdb::tools;
using openvdb::MaskTree;

/// @returns how many voxels that were.
std::uint64_t take_away(const MaskTree& removed, MaskTree& from) {
  const std::uint64_t before = from.activeVoxelCount();
  from.topologyDifference(removed);
  tools::prune(from);
  return before - from.activeVoxelCount();
}

/// The grid with less shadow. @param kept part of the grid's shadow.
std::shared_ptr<const StateGrid> with_shadow(const StateGrid& grid, const MaskTree& kept) {
  auto impl = std::make_unique<volume::detail::StateGridImpl>(grid.impl());
  MaskTree removed = impl->shadow;
  removed.topologyDifference(kept);
  const std::uint64_t count = removed.activeVoxelCount();
  impl->shadow.topologyDifference(removed);
  tools::prune(impl->shadow);
  impl->counts[std::size_t(VoxelState::shadow)] -= count;
  impl->counts[std::size_t(VoxelState::free)] += count;
  impl->report.unmeasured_shadow -= take_away(removed, impl->unmeasured);
  impl->report.outside_shadow -= take_away(removed, impl->outside);
  return std::make_shared<const StateGrid>(std::move(impl));
}

/// The voxels of a block whose region is one of the first `regions`.
volume::detail::BlockWords in_first_regions(const volume::detail::MaskBlock& block,
                                            const ShadowRegions& all, std::size_t regions) {
  volume::detail::BlockWords words{};
  volume::detail::for_each_on(block.words(), [&](int x, int y, int z) {
    const std::int32_t label =
        all.label(volume::detail::to_voxel(block.origin) + Eigen::Vector3i(x, y, z));
    words[std::size_t(x)] |= std::uint64_t(std::size_t(label) <= regions) << (8 * y + z);
  });
  return words;
}

}  // namespace

std::shared_ptr<const StateGrid> morphological_open(const StateGrid& grid, int radius_voxels) {
  if (radius_voxels < 0 || radius_voxels > 64) {
    throw bad_input("radius_voxels", fmt::format("is {}; expected 0 to 64 voxels", radius_voxels));
  }
  MaskTree opened = grid.impl().shadow;
  if (radius_voxels > 0) {
    opened.voxelizeActiveTiles();
    tools::erodeActiveValues(opened, radius_voxels, tools::NN_FACE_EDGE_VERTEX,
                             tools::IGNORE_TILES);
    tools::dilateActiveValues(opened, radius_voxels, tools::NN_FACE_EDGE_VERTEX,
                              tools::IGNORE_TILES);
  }
  return with_shadow(grid, opened);
}

int opening_radius(const StateGrid& grid, double edge_m) {
  if (!std::isfinite(edge_m) || edge_m < 0) {
    throw bad_input("edge_m", fmt::format("is {}; expected a finite length, 0 or above", edge_m));
  }
  // 2 radius + 1 voxels fit into the edge; a millionth for its division by the voxels' size.
  const double voxels = edge_m / grid.geometry().voxel_size_m() * (1 + 1e-6);
  return std::max(0, int(std::floor(0.5 * (voxels - 1))));
}

namespace {

bool filters(const WorldModel& world, const VolumeOptions& options) {
  if (options.filter != FalseShadowFilter::automatic) {
    return options.filter == FalseShadowFilter::on;
  }
  return options.noise.subpixel_px > 0 &&
         std::ranges::any_of(world.cameras,
                             [](const DepthCamera& c) { return c.depth != nullptr; });
}

}  // namespace

std::shared_ptr<const StateGrid> without_false_shadow(std::shared_ptr<const StateGrid> grid,
                                                      const WorldModel& world,
                                                      const VolumeOptions& options) {
  options.check();
  if (!filters(world, options)) return grid;
  const int radius = std::max(1, opening_radius(*grid, options.filter_m));
  const auto opened = morphological_open(*grid, std::min(radius, 64));
  const bool all_thin = opened->count(VoxelState::shadow) == 0;
  if (all_thin && options.filter == FalseShadowFilter::automatic) return grid;
  auto impl = std::make_unique<volume::detail::StateGridImpl>(opened->impl());
  impl->report.false_shadow = grid->count(VoxelState::shadow) - opened->count(VoxelState::shadow);
  return std::make_shared<const StateGrid>(std::move(impl));
}

MaskTree volume::detail::shell_voxels(const StateGrid& grid) {
  MaskTree around = grid.impl().shadow;
  around.voxelizeActiveTiles();
  tools::dilateActiveValues(around, 1, tools::NN_FACE_EDGE_VERTEX, tools::IGNORE_TILES);
  return around;
}

TriangleMesh shell_around_shadow(const StateGrid& grid) {
  return volume::detail::voxel_faces(volume::detail::shell_voxels(grid), grid.geometry());
}

std::shared_ptr<const StateGrid> remove_small_components(const StateGrid& grid, double min_m3) {
  if (!std::isfinite(min_m3) || min_m3 < 0) {
    throw bad_input("min_m3", fmt::format("is {}; expected a finite volume, 0 or above", min_m3));
  }
  const ShadowRegions regions(grid);
  std::size_t large = 0;  // they are sorted, largest first
  while (large < regions.list().size() &&
         double(regions.list()[large].voxels) * grid.geometry().voxel_volume_m3() >= min_m3) {
    ++large;
  }
  const std::vector<volume::detail::MaskBlock> blocks =
      volume::detail::mask_blocks(grid.impl().shadow);
  std::vector<volume::detail::BlockWords> kept(blocks.size());
  tbb::parallel_for(std::size_t(0), blocks.size(),
                    [&](std::size_t b) { kept[b] = in_first_regions(blocks[b], regions, large); });
  MaskTree shadow(false);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    shadow.touchLeaf(blocks[b].origin)->setValueMask(volume::detail::mask_of(kept[b]));
  }
  tools::pruneInactive(shadow);
  return with_shadow(grid, shadow);
}

}  // namespace vantage
