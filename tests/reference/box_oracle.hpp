#pragma once

#include <Eigen/Core>
#include <vector>

#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/volume/grid_geometry.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage::test {

/// A box around its own frame's origin.
struct TurnedBox {
  Eigen::Vector3d half;
  Pose T_world_box;

  /// Both with the half sizes changed by `slack_m`.
  bool contains(const Eigen::Vector3d& p_world, double slack_m = 0) const;
  bool meets(const Eigen::Vector3d& a_world, const Eigen::Vector3d& b_world, double slack_m) const;
};

/// What the oracle says of a point. `close_call`: it would say something else of boxes and images
/// that are larger or smaller by a hair.
struct OracleState {
  VoxelState state = VoxelState::shadow;
  bool unseen = true;  ///< in no camera's image and depth range
  bool close_call = false;
};

/// Closed form for worlds of boxes, seen by cameras without depth: a point is occupied if it is
/// inside a box, free if a camera has it in view and the segment to the camera meets no box. No
/// voxels, no triangles, double precision.
class BoxOracle {
 public:
  BoxOracle(std::vector<TurnedBox> boxes, std::vector<PinholeCamera> cameras)
      : boxes_(std::move(boxes)), cameras_(std::move(cameras)) {}

  OracleState classify(const Eigen::Vector3d& point) const;

 private:
  /// A positive slack makes the boxes larger and the images smaller.
  OracleState decide(const Eigen::Vector3d& point, double slack) const;

  std::vector<TurnedBox> boxes_;
  std::vector<PinholeCamera> cameras_;
};

/// Which voxels have their centre in a box, in the order of ThesisVolume's labels.
/// @param close_call set if a centre is so close to a face (1e-6 m) that float may disagree.
std::vector<char> solid_voxels(const std::vector<TurnedBox>& boxes, const GridGeometry& geometry,
                               bool& close_call);

}  // namespace vantage::test
