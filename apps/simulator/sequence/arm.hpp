#pragma once

#include <array>
#include <memory>
#include <vector>

#include "vantage/raycore/pose.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage {

/// Something of the arm, where it is at one time.
struct ArmPart {
  const char* name;
  std::shared_ptr<const TriangleMesh> mesh;
  Pose T_world_part;
};

/// An arm that reaches over the table: two links, whose elbow is above them, and a gripper that
/// hangs down. It is foreign to every camera, and hides what is behind it. Immutable.
class Arm {
 public:
  static constexpr double kLinkRadiusM = 0.035;
  static constexpr double kGripperM = 0.1;  ///< from the wrist down to the tip

  /// @param reach_m from the shoulder to the wrist, at most.
  /// @throws Error bad_input unless `shoulder` is finite and `reach_m` is above 0.1.
  Arm(const Eigen::Vector3d& shoulder, double reach_m);

  const Eigen::Vector3d& shoulder() const noexcept { return shoulder_; }

  /// With the tip of the gripper at a point; on the way there if that is too far.
  std::vector<ArmPart> at(const Eigen::Vector3d& tip) const;

 private:
  Eigen::Vector3d elbow_for(const Eigen::Vector3d& wrist) const;

  Eigen::Vector3d shoulder_;
  double link_m_;
  std::shared_ptr<const TriangleMesh> link_, gripper_;
};

/// Where the arm's tip is over time: on straight lines between points.
struct ArmPath {
  struct Point {
    double time_s = 0;
    Eigen::Vector3d tip;
  };
  std::vector<Point> points;  ///< ascending in time

  /// Before the first point there, after the last there.
  /// @throws Error bad_input for a path without points.
  Eigen::Vector3d at(double time_s) const;
};

}  // namespace vantage
