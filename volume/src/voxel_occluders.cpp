#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "occluders.hpp"
#include "vantage/raycore/scene_builder.hpp"
#include "voxel_boxes.hpp"

namespace vantage::detail {
namespace {

/// Voxels count as touched within this part of a voxel, so that a line through an edge or a corner
/// meets all the voxels there, however it is rounded.
constexpr double kTouch = 1e-9;

/// Cameras up to this many times the work area's size away from its corner are traced in packets.
constexpr double kReachOfPackets = 16;

/// A line of sight that walks from voxel to voxel (Amanatides and Woo, "A fast voxel traversal
/// algorithm for ray tracing", 1987), in index coordinates, from a voxel's centre to a camera.
class VoxelWalk {
 public:
  VoxelWalk(const Eigen::Vector3i& voxel, const Eigen::Vector3d& camera) : voxel_(voxel) {
    for (int axis = 0; axis < 3; ++axis) {
      const double d = camera[axis] - (voxel[axis] + 0.5);
      step_[axis] = d > 0 ? 1 : -1;
      // A line within a plane of centres never leaves it.
      per_voxel_[axis] = d != 0 ? 1 / std::abs(d) : 0;
      next_[axis] = d != 0 ? 0.5 * per_voxel_[axis] : std::numeric_limits<double>::infinity();
    }
  }

  /// Whether the line meets a voxel for which `solid` holds before it ends or leaves `range`.
  template <class Solid>
  bool meets(const CellRange& range, const Solid& solid) {
    while (true) {
      const int axis =
          next_[0] <= next_[1] ? (next_[0] <= next_[2] ? 0 : 2) : (next_[1] <= next_[2] ? 1 : 2);
      if (next_[axis] > 1) return false;
      bool together[3];
      bool alone = true;
      for (int other = 0; other < 3; ++other) {
        together[other] = other == axis || next_[other] - next_[axis] <=
                                               kTouch * (per_voxel_[axis] + per_voxel_[other]);
        alone &= other == axis || !together[other];
      }
      if (!alone && touches_beside(together, range, solid)) return true;
      for (int other = 0; other < 3; ++other) {
        if (together[other]) advance(other);
      }
      if (leaves(range)) return false;
      if (inside(range, voxel_) && solid(voxel_)) return true;
    }
  }

 private:
  void advance(int axis) {
    voxel_[axis] += step_[axis];
    ++crossed_[axis];
    next_[axis] = (crossed_[axis] + 0.5) * per_voxel_[axis];  // no error adds up
  }

  static bool inside(const CellRange& range, const Eigen::Vector3i& v) {
    return (v.array() >= range.first.array()).all() && (v.array() < range.last.array()).all();
  }

  /// Whether the rest of the line cannot come back to `range`.
  bool leaves(const CellRange& range) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (step_[axis] > 0 ? voxel_[axis] >= range.last[axis] + 1
                          : voxel_[axis] < range.first[axis] - 1) {
        return true;
      }
    }
    return false;
  }

  /// The line crosses several planes in one place: the voxels around that edge or corner.
  template <class Solid>
  bool touches_beside(const bool (&together)[3], const CellRange& range, const Solid& solid) const {
    for (int part = 1; part < 7; ++part) {
      Eigen::Vector3i beside = voxel_;
      bool valid = true;
      for (int axis = 0; axis < 3; ++axis) {
        if ((part >> axis & 1) == 0) continue;
        valid &= together[axis];
        beside[axis] += step_[axis];
      }
      if (valid && inside(range, beside) && solid(beside)) return true;
    }
    return false;
  }

  Eigen::Vector3i voxel_, step_, crossed_ = Eigen::Vector3i::Zero();
  Eigen::Vector3d per_voxel_;  ///< line parameter from one plane to the next
  Eigen::Vector3d next_;       ///< line parameter of the next plane
};

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
    SceneBuilder builder;
    builder.add_mesh(larger_boxes());
    larger_ = builder.build();
  }

  bool empty() const override { return filled_.empty(); }

  /// Packets of rays against slightly larger boxes tell which lines of sight are free for certain:
  /// most of them. The others are walked in double precision.
  void hidden(std::span<const Eigen::Vector3i> voxels, PointsView centres,
              const Eigen::Vector3d& camera_centre, std::span<std::uint8_t> result) const override {
    if (camera_centre.cwiseAbs().maxCoeff() <= reach_m_) {
      larger_->occluded(centres, camera_centre.cast<float>(), result);
    } else {
      std::fill(result.begin(), result.end(), std::uint8_t(1));
    }
    const Eigen::Vector3d camera = camera_centre / voxel_size_m_;
    for (std::size_t i = 0; i < voxels.size(); ++i) {
      if (result[i] == 0) continue;
      result[i] = VoxelWalk(voxels[i], camera).meets(bounds_, [&](const Eigen::Vector3i& v) {
        return solid_.test(v);
      });
    }
  }

  void add_contours(const PinholeCamera& camera, ContourMap& map) const override {
    const Eigen::Vector3d centre = camera.centre() / voxel_size_m_;
    tbb::parallel_for(std::size_t(0), filled_.size(), [&](std::size_t i) {
      const Eigen::Vector3i& block = filled_[i];
      const std::size_t index = solid_.layout().index(block);
      solid_.bits(index).for_each([&](int offset) {
        add_contours_of(kBlockSide * block + voxel_in_block(offset), centre, map);
      });
    });
  }

 private:
  /// Boxes around the solid voxels, larger by more than rays to cameras within `reach_m_` err.
  TriangleMesh larger_boxes() const {
    const Eigen::Vector3d grow = Eigen::Vector3d::Constant(kRoundingOfRays * reach_m_);
    std::vector<Box> boxes;
    for (const CellRange& box : voxel_boxes(solid_)) {
      boxes.emplace_back(voxel_size_m_ * box.first.cast<double>() - grow,
                         voxel_size_m_ * box.last.cast<double>() + grow);
    }
    return TriangleMesh::from_boxes(boxes);
  }

  bool solid(const Eigen::Vector3i& v) const {
    return (v.array() >= bounds_.first.array()).all() && (v.array() < bounds_.last.array()).all() &&
           solid_.test(v);
  }

  /// The outline among a voxel's twelve edges. Around an edge there are four voxels: the one on the
  /// camera's side, the one beyond, and two beside. Lines of sight over the edge pass the one or
  /// the other of the latter: it is an outline if just one of them is solid and neither of the
  /// former.
  void add_contours_of(const Eigen::Vector3i& voxel, const Eigen::Vector3d& camera,
                       ContourMap& map) const {
    for (int axis = 0; axis < 3; ++axis) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      for (int corner = 0; corner < 4; ++corner) {
        Eigen::Vector3i to_a = Eigen::Vector3i::Zero(), to_b = to_a, edge = voxel;
        to_a[a] = (corner & 1) != 0 ? 1 : -1, to_b[b] = (corner & 2) != 0 ? 1 : -1;
        edge[a] += corner & 1, edge[b] += corner >> 1;
        const bool at_a = solid(voxel + to_a), at_b = solid(voxel + to_b);
        const bool across = solid(voxel + to_a + to_b);
        if (at_a && at_b && across) continue;
        if (is_outline(camera[a] - edge[a], to_a[a], camera[b] - edge[b], to_b[b], at_a, at_b,
                       across)) {
          add_edge(edge, axis, map);
        }
      }
    }
  }

  /// Seen from a solid voxel: its neighbours towards a and b, and the one across the edge.
  static bool is_outline(double camera_a, int to_a, double camera_b, int to_b, bool at_a, bool at_b,
                         bool across) {
    const double unsure = 1e-3;  // voxels
    if (std::abs(camera_a) < unsure || std::abs(camera_b) < unsure) return true;
    const bool beyond_a = camera_a * to_a > 0, beyond_b = camera_b * to_b > 0;
    // The camera in this voxel's own quadrant or in the opposite one: it blocks both ways.
    if (beyond_a == beyond_b) return false;
    // Now the neighbours at a and b are the near and the far one; this voxel and the one across
    // are beside.
    return !at_a && !at_b && !across;
  }

  void add_edge(const Eigen::Vector3i& corner, int axis, ContourMap& map) const {
    const Eigen::Vector3d from = voxel_size_m_ * corner.cast<double>();
    map.add_edge(from, from + voxel_size_m_ * Eigen::Vector3d::Unit(axis), 1e-9 * voxel_size_m_);
  }

  const BlockSet& solid_;
  double voxel_size_m_;
  double reach_m_;
  std::shared_ptr<const Scene> larger_;
  std::vector<Eigen::Vector3i> filled_;
  CellRange bounds_;
};

}  // namespace

std::unique_ptr<const Occluders> voxel_occluders(const BlockSet& solid, double voxel_size_m) {
  return std::make_unique<const VoxelOccluders>(solid, voxel_size_m);
}

}  // namespace vantage::detail
