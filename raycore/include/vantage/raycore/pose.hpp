#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string_view>

#include "vantage/raycore/export.hpp"

namespace vantage {

/// A rigid motion. `T_target_source` maps: `p_target = T_target_source * p_source`. Metres.
///
/// Always valid: finite, and its rotation is orthonormal with determinant +1. Immutable value type.
class VANTAGE_API Pose {
 public:
  /// The identity.
  Pose() = default;

  /// `rotation` may be off by 1e-3 per entry of RᵀR, as rotations in text files are; the closest
  /// rotation is used. `where` names the place in errors.
  /// @throws Error bad_input if anything is not finite, or if `rotation` is not a rotation.
  static Pose from_rotation(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation,
                            std::string_view where = "pose");

  /// @throws Error bad_input if anything is not finite, or if the norm is off 1 by more than 1e-3.
  static Pose from_quaternion(const Eigen::Quaterniond& rotation,
                              const Eigen::Vector3d& translation, std::string_view where = "pose");

  static Pose from_translation(const Eigen::Vector3d& translation);

  /// The pose T_world_cam of a camera at `eye` whose optical axis goes through `target`, with the
  /// image's up direction as close to world +z as can be (to world +y for one that looks along z).
  /// @throws Error bad_input if the two points coincide or are not finite.
  static Pose looking_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target);

  const Eigen::Matrix3d& rotation() const noexcept { return rotation_; }
  const Eigen::Vector3d& translation() const noexcept { return translation_; }

  /// Unit norm, w >= 0.
  Eigen::Quaterniond quaternion() const;

  Pose inverse() const;
  Pose operator*(const Pose& other) const;
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation_ * point + translation_;
  }

 private:
  Pose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation)
      : rotation_(rotation), translation_(translation) {}

  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation_ = Eigen::Vector3d::Zero();
};

/// The smallest rotation that takes one direction to another, of unit norm; for opposite ones about
/// any axis across. Neither need be of unit length. (Eigen's FromTwoVectors does the same by way of
/// a singular value decomposition, which takes seconds to compile.)
VANTAGE_API Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from,
                                                const Eigen::Vector3d& to);

/// Covariance of a pose. Translation (x, y, z, m²) before rotation (a rotation vector around x, y,
/// z, rad²), both in the parent frame, as ROS has it: the true pose is (exp(r) R, translation + t)
/// for a small (t, r). For a T_world_object the parent is the world.
using Matrix6d = Eigen::Matrix<double, 6, 6>;

}  // namespace vantage
