#include "vantage/raycore/pose.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <cmath>
#include <string>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr double kTolerance = 1e-3;  // what rounding in text files leaves, with room to spare

void check_translation(const Eigen::Vector3d& t, std::string_view where) {
  if (t.allFinite()) return;
  throw bad_input(std::string(where),
                  fmt::format("the translation [{}, {}, {}] is not finite", t.x(), t.y(), t.z()));
}

/// The closest rotation in the Frobenius norm.
Eigen::Matrix3d closest_rotation(const Eigen::Matrix3d& m) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(m, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

}  // namespace

Pose Pose::from_rotation(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation,
                         std::string_view where) {
  check_translation(translation, where);
  if (!rotation.allFinite()) throw bad_input(std::string(where), "the rotation is not finite");
  const double off =
      (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= kTolerance)) {
    throw bad_input(std::string(where),
                    fmt::format("this is not a rotation: RᵀR differs from the identity by {:.3g}; "
                                "expected an orthonormal 3×3 matrix, row by row",
                                off));
  }
  if (rotation.determinant() < 0) {
    throw bad_input(std::string(where),
                    "this is a reflection (determinant -1), not a rotation; one axis is flipped");
  }
  return {closest_rotation(rotation), translation};
}

Pose Pose::from_quaternion(const Eigen::Quaterniond& rotation, const Eigen::Vector3d& translation,
                           std::string_view where) {
  check_translation(translation, where);
  const double norm = rotation.norm();
  if (!(std::abs(norm - 1) <= kTolerance)) {
    throw bad_input(
        std::string(where),
        fmt::format("the quaternion {{w: {}, x: {}, y: {}, z: {}}} has the norm {:.6g}; "
                    "expected 1",
                    rotation.w(), rotation.x(), rotation.y(), rotation.z(), norm));
  }
  return {rotation.normalized().toRotationMatrix(), translation};
}

Pose Pose::from_translation(const Eigen::Vector3d& translation) {
  check_translation(translation, "pose");
  return {Eigen::Matrix3d::Identity(), translation};
}

Pose Pose::looking_at(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  check_translation(eye, "eye");
  check_translation(target, "target");
  const Eigen::Vector3d towards = target - eye;
  if (towards.isZero(0)) {
    throw bad_input("target", "it coincides with the eye, so there is no viewing direction");
  }
  if (!towards.allFinite()) throw bad_input("target", "it is too far from the eye");
  const Eigen::Vector3d forward = towards.stableNormalized();
  const bool along_z = forward.head<2>().norm() < 1e-9;
  const Eigen::Vector3d up = along_z ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  Eigen::Matrix3d axes;  // x right, y down, z forward
  axes.col(2) = forward;
  axes.col(0) = forward.cross(up).normalized();
  axes.col(1) = forward.cross(axes.col(0));
  return {axes, eye};
}

Eigen::Quaterniond rotation_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d a = from.normalized(), b = to.normalized();
  const Eigen::Vector3d across = a.cross(b);
  const double sine = across.norm();
  const bool parallel = sine < 1e-12;  // the rest is rounding, and does not determine an axis
  if (parallel && a.dot(b) > 0) return Eigen::Quaterniond::Identity();
  const Eigen::Vector3d axis = parallel ? a.unitOrthogonal() : Eigen::Vector3d(across / sine);
  // Half the angle's cosine and sine, without cancellation near half a turn.
  const Eigen::Vector3d v = 0.5 * (a - b).norm() * axis;
  return Eigen::Quaterniond(0.5 * (a + b).norm(), v.x(), v.y(), v.z()).normalized();
}

Eigen::Quaterniond Pose::quaternion() const {
  Eigen::Quaterniond q(rotation_);
  if (q.w() < 0) q.coeffs() *= -1;
  return q.normalized();
}

Pose Pose::inverse() const {
  return {rotation_.transpose(), -(rotation_.transpose() * translation_)};
}

Pose Pose::operator*(const Pose& other) const {
  return {rotation_ * other.rotation_, *this * other.translation_};
}

}  // namespace vantage
