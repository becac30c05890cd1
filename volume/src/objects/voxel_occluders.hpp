#pragma once

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <vector>

#include "grid/block_set.hpp"
#include "grid/blocks.hpp"

namespace vantage::volume::detail {

/// Boxes of voxels that together are a set, disjoint; none reaches beyond its block. Rows along z
/// are joined along y where they are equal, and those sheets along x.
std::vector<CellRange> voxel_boxes(const BlockSet& set);

/// Voxels count as touched within this part of a voxel, so that a line through an edge or a corner
/// meets all the voxels there, however it is rounded.
inline constexpr double kTouch = 1e-9;

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

}  // namespace vantage::volume::detail
