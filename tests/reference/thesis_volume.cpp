#include "reference/thesis_volume.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#include "reference/plain_classify.hpp"

namespace vantage::test {
namespace {

constexpr double kGrown = 1e-9;  // voxels

/// Index coordinates: the corners of voxels are at integers.
struct Segment {
  Eigen::Vector3d from, direction, inverse;

  Segment(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
      : from(a), direction(b - a), inverse(direction.cwiseInverse()) {}

  /// The slab test.
  bool meets(const Eigen::Vector3i& voxel) const {
    double enter = 0, leave = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = voxel[axis] - kGrown - from[axis];
      const double high = voxel[axis] + 1 + kGrown - from[axis];
      if (direction[axis] == 0) {
        if (low > 0 || high < 0) return false;
        continue;
      }
      const double a = low * inverse[axis], b = high * inverse[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
      if (enter > leave) return false;
    }
    return true;
  }
};

/// Steps to the six neighbours.
const std::vector<Eigen::Vector3i> kNeighbours = {{-1, 0, 0}, {1, 0, 0},  {0, -1, 0},
                                                  {0, 1, 0},  {0, 0, -1}, {0, 0, 1}};

/// How many of a voxel's neighbours in the grid are `wanted`.
template <class Wanted>
int count_neighbours(const ThesisVolume& volume, const Eigen::Vector3i& voxel,
                     const Wanted& wanted) {
  return int(
      std::count_if(kNeighbours.begin(), kNeighbours.end(), [&](const Eigen::Vector3i& step) {
        return volume.geometry.contains(voxel + step) && wanted(volume.index(voxel + step));
      }));
}

void process_visibility(ThesisVolume& volume, const std::vector<Eigen::Vector3i>& solids,
                        const PinholeCamera& camera) {
  const GridGeometry& geometry = volume.geometry;
  const Eigen::Vector3d eye = (camera.centre() - geometry.origin()) / geometry.voxel_size_m();
  for_each_voxel(geometry, [&](const Eigen::Vector3i& voxel) {
    const std::size_t i = volume.index(voxel);
    if (volume.labels[i] == VoxelState::occupied) return;
    bool close_call = false;
    const bool in_view = plain_in_view(camera, geometry.centre(voxel), close_call);
    volume.close_call[i] |= char(close_call);
    if (!in_view) return;
    volume.unseen[i] = false;
    if (volume.labels[i] != VoxelState::shadow) return;
    const Segment to_camera(voxel.cast<double>() + Eigen::Vector3d::Constant(0.5), eye);
    if (std::none_of(solids.begin(), solids.end(),
                     [&](const Eigen::Vector3i& solid) { return to_camera.meets(solid); })) {
      volume.labels[i] = VoxelState::free;
    }
  });
}

}  // namespace

std::size_t ThesisVolume::index(const Eigen::Vector3i& voxel) const {
  const Eigen::Vector3i& n = geometry.size();
  return (std::size_t(voxel.x()) * std::size_t(n.y()) + std::size_t(voxel.y())) *
             std::size_t(n.z()) +
         std::size_t(voxel.z());
}

std::uint64_t ThesisVolume::count(VoxelState state) const {
  return std::uint64_t(std::count(labels.begin(), labels.end(), state));
}

ThesisVolume thesis_volume(const GridGeometry& geometry, const std::vector<char>& solid,
                           std::span<const PinholeCamera> cameras, bool anti_alias) {
  assert(solid.size() == geometry.voxel_count());
  ThesisVolume volume{geometry, std::vector<VoxelState>(solid.size(), VoxelState::shadow),
                      std::vector<char>(solid.size(), true), std::vector<char>(solid.size())};
  std::vector<Eigen::Vector3i> solids;
  for_each_voxel(geometry, [&](const Eigen::Vector3i& voxel) {
    const std::size_t i = volume.index(voxel);
    if (!solid[i]) return;
    solids.push_back(voxel);
    volume.labels[i] = VoxelState::occupied;
  });
  for (const PinholeCamera& camera : cameras) process_visibility(volume, solids, camera);
  if (anti_alias) thesis_anti_alias(volume);
  for (std::size_t i = 0; i < solid.size(); ++i) {
    volume.unseen[i] &= char(volume.labels[i] == VoxelState::shadow);
  }
  return volume;
}

void thesis_anti_alias(ThesisVolume& volume) {
  const ThesisVolume before = volume;
  for_each_voxel(volume.geometry, [&](const Eigen::Vector3i& voxel) {
    const std::size_t i = volume.index(voxel);
    const int score = count_neighbours(
        before, voxel, [&](std::size_t n) { return before.labels[n] == VoxelState::shadow; });
    if (before.labels[i] == VoxelState::shadow && score < 5) volume.labels[i] = VoxelState::free;
    if (count_neighbours(before, voxel, [&](std::size_t n) { return before.close_call[n] != 0; })) {
      volume.close_call[i] = true;
    }
  });
}

}  // namespace vantage::test
