#include "tracking/pose_filter.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "pose/symmetry.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kLeftOver = 0.1;  ///< of common errors, in variance, between the same cameras

/// Squared metres, at the surface of an object of 5 cm.
double size_of(const Matrix6d& covariance) {
  constexpr double kArm_m = 0.05;
  return covariance.topLeftCorner<3, 3>().trace() +
         kArm_m * kArm_m * covariance.bottomRightCorner<3, 3>().trace();
}

double angle_between(const Pose& a, const Pose& b) {
  return rotation_vector(a.rotation() * b.rotation().transpose()).norm();
}

}  // namespace

void PoseFilter::predict(double creep_m, double creep_rad) {
  state_.noise.diagonal().head<3>().array() += creep_m * creep_m;
  state_.noise.diagonal().tail<3>().array() += creep_rad * creep_rad;
}

Vector6d PoseFilter::innovation(const PoseMeasurement& measured) const {
  Vector6d step;
  step.head<3>() = measured.T_world_object.translation() - pose().translation();
  step.tail<3>() =
      rotation_vector(measured.T_world_object.rotation() * pose().rotation().transpose());
  return step;
}

Matrix6d PoseFilter::innovation_covariance(const PoseMeasurement& measured,
                                           bool same_cameras) const {
  const double share = same_cameras ? kLeftOver : 1;
  return state_.noise + measured.noise + share * (state_.common + measured.common);
}

void PoseFilter::update(const PoseMeasurement& measured) {
  // What only one of both has is no error of all pictures: a feature that was read wrongly, say.
  const bool smaller = size_of(measured.common) < size_of(state_.common);
  const Matrix6d common = smaller ? measured.common : state_.common;
  const Matrix6d own = state_.noise + without_negative(state_.common - common);
  const Matrix6d other = measured.noise + without_negative(measured.common - common);
  const Matrix6d gain = Eigen::LDLT<Matrix6d>(Matrix6d(own + other)).solve(own).transpose();
  state_.T_world_object = moved(pose(), Vector6d(gain * innovation(measured)));
  const Matrix6d rest = Matrix6d::Identity() - gain;
  state_.noise = rest * own * rest.transpose() + gain * other * gain.transpose();
  state_.common = common;
}

NormalLikelihood likelihood_of(const Vector6d& innovation, const Matrix6d& covariance) {
  const Eigen::LLT<Matrix6d> factor(covariance);
  NormalLikelihood result;
  result.squared_distance = factor.matrixL().solve(innovation).squaredNorm();
  const double log_of_root = factor.matrixLLT().diagonal().array().log().sum();
  result.negative_log =
      0.5 * result.squared_distance + log_of_root + 3 * std::log(2 * std::numbers::pi);
  return result;
}

Matrix6d without_negative(const Matrix6d& symmetric) {
  if (symmetric.isZero(0)) return symmetric;
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(symmetric);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).asDiagonal() *
         solver.eigenvectors().transpose();
}

Pose nearest_equal_pose(const ObjectType& type, const Pose& pose, const Pose& target) {
  Pose nearest = turned_towards(type, pose, target);
  for (const Pose& symmetry : type.symmetries.discrete) {
    const Pose other = turned_towards(type, pose * symmetry, target);
    if (angle_between(other, target) < angle_between(nearest, target)) nearest = other;
  }
  return nearest;
}

}  // namespace vantage::reconstruction::detail
