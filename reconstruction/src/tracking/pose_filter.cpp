#include "tracking/pose_filter.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <numbers>

#include "pose/symmetry.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kLeftOver = 0.1;  ///< of common errors, in variance, between the same cameras

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
  const Matrix6d sum = state_.noise + measured.noise;
  const Eigen::LDLT<Matrix6d> solver(sum);
  const Matrix6d gain = solver.solve(state_.noise).transpose();
  state_.T_world_object = moved(pose(), Vector6d(gain * innovation(measured)));
  const Matrix6d rest = Matrix6d::Identity() - gain;
  state_.noise = rest * state_.noise * rest.transpose() + gain * measured.noise * gain.transpose();
  const double weight = gain.trace() / 6;
  state_.common = (1 - weight) * state_.common + weight * measured.common;
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

Pose nearest_equal_pose(const ObjectType& type, const Pose& pose, const Pose& target) {
  Pose nearest = turned_towards(type, pose, target);
  for (const Pose& symmetry : type.symmetries.discrete) {
    const Pose other = turned_towards(type, pose * symmetry, target);
    if (angle_between(other, target) < angle_between(nearest, target)) nearest = other;
  }
  return nearest;
}

}  // namespace vantage::reconstruction::detail
