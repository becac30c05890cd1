#include "volume/make_grid.hpp"

#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

#include "grid/state_grid_impl.hpp"

namespace vantage::test {
namespace {

/// Numbers that look random, from a seed and a place.
std::uint32_t hash(std::uint32_t seed, const Eigen::Vector3i& v) {
  std::uint32_t h = seed * 2654435761u;
  for (const int coordinate : {v.x(), v.y(), v.z()}) {
    h = (h ^ std::uint32_t(coordinate)) * 2246822519u;
    h ^= h >> 15;
  }
  return h * 3266489917u ^ h >> 13;
}

}  // namespace

std::shared_ptr<const StateGrid> make_grid(
    const GridGeometry& geometry, const std::function<MadeVoxel(const Eigen::Vector3i&)>& what,
    bool tiles) {
  auto impl = std::make_unique<volume::detail::StateGridImpl>(geometry);
  openvdb::MaskTree* const trees[] = {nullptr, &impl->occupied, &impl->shadow, &impl->revealed};
  for_each_voxel(geometry, [&](const Eigen::Vector3i& voxel) {
    const MadeVoxel made = what(voxel);
    ++impl->counts[std::size_t(made.state)];
    if (made.state == VoxelState::free) return;
    const openvdb::Coord place = volume::detail::to_coord(voxel);
    trees[std::size_t(made.state)]->setValueOn(place);
    if (made.measured) impl->measured.setValueOn(place);
    if (made.state == VoxelState::occupied) return;
    const bool unmeasured = made.cause == ShadowCause::unmeasured;
    const bool outside = made.cause == ShadowCause::outside;
    if (unmeasured) impl->unmeasured.setValueOn(place);
    if (outside) impl->outside.setValueOn(place);
    impl->report.unmeasured_shadow += unmeasured;
    impl->report.outside_shadow += outside;
  });
  if (tiles) {
    for (auto* tree : {&impl->occupied, &impl->shadow, &impl->revealed, &impl->measured,
                       &impl->unmeasured, &impl->outside}) {
      openvdb::tools::prune(*tree);
    }
  }
  return std::make_shared<const StateGrid>(std::move(impl));
}

std::shared_ptr<const StateGrid> shadow_where(const GridGeometry& geometry, const Inside& inside) {
  return make_grid(geometry, [&](const Eigen::Vector3i& voxel) -> MadeVoxel {
    return {inside(voxel) ? VoxelState::shadow : VoxelState::free};
  });
}

Inside ball(const Eigen::Vector3d& centre, double radius) {
  return [=](const Eigen::Vector3i& v) {
    return (v.cast<double>() + Eigen::Vector3d::Constant(0.5) - centre).norm() < radius;
  };
}

Inside box(const Eigen::Vector3i& first, const Eigen::Vector3i& end) {
  return [=](const Eigen::Vector3i& v) {
    return (v.array() >= first.array()).all() && (v.array() < end.array()).all();
  };
}

GridGeometry geometry_of(int nx, int ny, int nz) {
  const Eigen::Vector3d low(-0.31, 0.17, 0.02);
  return GridGeometry::covering(Box(low, low + 0.01 * Eigen::Vector3d(nx, ny, nz)), 0.01);
}

std::function<MadeVoxel(const Eigen::Vector3i&)> random_voxels(std::uint32_t seed) {
  return [seed](const Eigen::Vector3i& voxel) -> MadeVoxel {
    const std::uint32_t block = hash(seed, voxel / 8), own = hash(seed + 1, voxel);
    constexpr VoxelState kStates[] = {VoxelState::free, VoxelState::occupied, VoxelState::shadow,
                                      VoxelState::shadow, VoxelState::revealed};
    const bool uniform = block % 3 != 0;
    const VoxelState state = kStates[(uniform ? block >> 8 : own >> 8) % 5];
    const std::uint32_t more = uniform ? block >> 16 : own >> 16;
    return {state, state == VoxelState::occupied && (more & 1) != 0, ShadowCause(more % 3)};
  };
}

}  // namespace vantage::test
