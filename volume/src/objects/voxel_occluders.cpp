#include "objects/voxel_occluders.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "grid/block_set.hpp"
#include "objects/occluders.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage::volume::detail {
namespace {

/// Takes the voxels of one box out of `left`, starting at its lowest one.
CellRange take_box(BlockBits& left) {
  const Eigen::Vector3i first = voxel_in_block(left.first());
  const auto row = [&](int x, int y) {
    return unsigned(left.words[std::size_t(x)] >> (8 * y)) & 0xFFu;
  };
  int z = first.z();
  while (z < kBlockSide && (row(first.x(), first.y()) >> z & 1u) != 0) ++z;
  const unsigned run = ((1u << z) - 1u) & ~((1u << first.z()) - 1u);

  int y = first.y();
  while (y < kBlockSide && (row(first.x(), y) & run) == run) ++y;
  std::uint64_t sheet = 0;
  for (int j = first.y(); j < y; ++j) sheet |= std::uint64_t(run) << (8 * j);

  int x = first.x();
  while (x < kBlockSide && (left.words[std::size_t(x)] & sheet) == sheet) {
    left.words[std::size_t(x++)] &= ~sheet;
  }
  return {first, {x, y, z}};
}

}  // namespace

std::vector<CellRange> voxel_boxes(const BlockSet& set) {
  std::vector<CellRange> boxes;
  const BlockLayout& layout = set.layout();
  for (std::size_t index = 0; index < layout.block_count(); ++index) {
    if (set.none(index)) continue;
    const Eigen::Vector3i corner = kBlockSide * layout.block_at(index);
    for (BlockBits left = set.bits(index); !left.none();) {
      const CellRange box = take_box(left);
      boxes.push_back({corner + box.first, corner + box.last});
    }
  }
  return boxes;
}

namespace {

/// Cameras up to this many times the work area's size away from its corner are traced in packets.
constexpr double kReachOfPackets = 16;

class VoxelOccluders final : public Occluders {
 public:
  VoxelOccluders(const BlockSet& solid, double voxel_size_m)
      : solid_(solid),
        voxel_size_m_(voxel_size_m),
        reach_m_(kReachOfPackets * voxel_size_m * solid.layout().voxels().last.maxCoeff()) {
    const BlockLayout& layout = solid.layout();
    Eigen::Vector3i low = layout.voxels().last, high = Eigen::Vector3i::Zero();
    layout.blocks().for_each([&](const Eigen::Vector3i& block) {
      if (solid_.none(layout.index(block))) return;
      filled_.push_back(block);
      low = low.cwiseMin(layout.voxels_in_block(block).first);
      high = high.cwiseMax(layout.voxels_in_block(block).last);
    });
    bounds_ = {low, high};
    // By more than rays err to cameras within reach, by less than half a voxel.
    const double err_m = kRoundingOfRays * reach_m_;
    if (2 * err_m >= voxel_size_m) reach_m_ = 0;
    if (reach_m_ > 0) larger_ = boxes(err_m), smaller_ = boxes(-err_m);
  }

  bool empty() const override { return filled_.empty(); }

  /// Packets of rays against slightly larger and slightly smaller boxes tell which lines of sight
  /// are free for certain, and which are blocked. What is left is walked in double precision.
  void hidden(std::span<const Eigen::Vector3i> voxels, PointsView centres,
              const Eigen::Vector3d& camera_centre, std::span<std::uint8_t> result) const override {
    std::vector<std::size_t> left;
    if (reach_m_ > 0 && camera_centre.cwiseAbs().maxCoeff() <= reach_m_) {
      left = undecided_by_packets(centres, camera_centre.cast<float>(), result);
    } else {
      for (std::size_t i = 0; i < voxels.size(); ++i) left.push_back(i);
    }
    const Eigen::Vector3d camera = camera_centre / voxel_size_m_;
    for (const std::size_t i : left) {
      result[i] = VoxelWalk(voxels[i], camera).meets(bounds_, [&](const Eigen::Vector3i& v) {
        return solid_.test(v);
      });
    }
  }

  /// Around an edge of the lattice there are four voxels: the one on the camera's side, the one
  /// beyond, and two beside. Lines of sight over the edge pass the one or the other of the latter:
  /// it is an outline if just one of them is solid, and neither of the former.
  void add_contours(const PinholeCamera& camera, ContourMap& map) const override {
    const Eigen::Vector3d centre = camera.centre() / voxel_size_m_;
    tbb::parallel_for(std::size_t(0), filled_.size(), [&](std::size_t i) {
      const Neighbourhood solid(solid_, solid_.layout().index(filled_[i]));
      BlockBits open[3][2];  // where the neighbour along an axis, down or up, is not solid
      for (int axis = 0; axis < 3; ++axis) {
        for (int up = 0; up < 2; ++up) open[axis][up] = ~solid.shifted(axis, 2 * up - 1);
      }
      for (int axis = 0; axis < 3; ++axis) {
        const int a = (axis + 1) % 3, b = (axis + 2) % 3;
        for (int corner = 0; corner < 4; ++corner) {
          const int up_a = corner & 1, up_b = corner >> 1;
          (solid.here() & open[a][up_a] & open[b][up_b]).for_each([&](int offset) {
            const Eigen::Vector3i voxel = kBlockSide * filled_[i] + voxel_in_block(offset);
            add_contour(voxel, axis, up_a, up_b, centre, map);
          });
        }
      }
    });
  }

 private:
  std::vector<std::size_t> undecided_by_packets(PointsView centres, const Eigen::Vector3f& camera,
                                                std::span<std::uint8_t> result) const {
    larger_->occluded(centres, camera, result);
    std::vector<std::size_t> near;
    Points from;
    for (std::size_t i = 0; i < centres.size; ++i) {
      if (result[i] == 0) continue;
      near.push_back(i);
      from.push_back(centres[i]);
    }
    std::vector<std::uint8_t> blocked(near.size());
    smaller_->occluded(from, camera, blocked);
    std::size_t left = 0;
    for (std::size_t i = 0; i < near.size(); ++i) {
      if (blocked[i] == 0) near[left++] = near[i];
    }
    near.resize(left);
    return near;
  }

  /// The solid voxels as boxes that are `grow_m` larger to every side.
  std::shared_ptr<const Scene> boxes(double grow_m) const {
    const Eigen::Vector3d grow = Eigen::Vector3d::Constant(grow_m);
    std::vector<Box> boxes;
    for (const CellRange& box : voxel_boxes(solid_)) {
      boxes.emplace_back(voxel_size_m_ * box.first.cast<double>() - grow,
                         voxel_size_m_ * box.last.cast<double>() + grow);
    }
    SceneBuilder builder;
    builder.add_mesh(TriangleMesh::from_boxes(boxes));
    return builder.build();
  }

  bool solid(const Eigen::Vector3i& v) const {
    return (v.array() >= bounds_.first.array()).all() && (v.array() < bounds_.last.array()).all() &&
           solid_.test(v);
  }

  /// One of the edges along `axis` of a solid voxel whose neighbours at the edge are not solid.
  void add_contour(const Eigen::Vector3i& voxel, int axis, int up_a, int up_b,
                   const Eigen::Vector3d& camera, ContourMap& map) const {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    Eigen::Vector3i across = voxel, edge = voxel;
    across[a] += 2 * up_a - 1, across[b] += 2 * up_b - 1;
    edge[a] += up_a, edge[b] += up_b;
    if (solid(across)) return;
    // In the voxel's own quadrant or in the one across, the camera has it before or beyond the
    // edge.
    const double unsure = 1e-3;  // voxels
    const double to_a = camera[a] - edge[a], to_b = camera[b] - edge[b];
    const bool sure = std::abs(to_a) > unsure && std::abs(to_b) > unsure;
    const bool beyond_a = (to_a > 0) == (up_a != 0), beyond_b = (to_b > 0) == (up_b != 0);
    if (sure && beyond_a == beyond_b) return;
    const Eigen::Vector3d from = voxel_size_m_ * edge.cast<double>();
    map.add_edge(from, from + voxel_size_m_ * Eigen::Vector3d::Unit(axis), 1e-9 * voxel_size_m_);
  }

  const BlockSet& solid_;
  double voxel_size_m_;
  double reach_m_;  ///< cameras with a larger coordinate are not traced in packets
  std::shared_ptr<const Scene> larger_, smaller_;
  std::vector<Eigen::Vector3i> filled_;
  CellRange bounds_;
};

}  // namespace

std::unique_ptr<const Occluders> voxel_occluders(const BlockSet& solid, double voxel_size_m) {
  return std::make_unique<const VoxelOccluders>(solid, voxel_size_m);
}

}  // namespace vantage::volume::detail
