#include "pose/pose_costs.hpp"

#include <cmath>

#include "pose/pose_manifold.hpp"

namespace vantage::reconstruction::detail {
namespace {

/// exp(r) exp(v) = exp(v + m r) for small r. Barfoot, "State Estimation for Robotics", the inverse
/// of the left Jacobian of SO(3).
Eigen::Matrix3d log_by_left_step(const Eigen::Vector3d& v) {
  const double angle = v.norm();
  const Eigen::Matrix3d cross = cross_matrix(v);
  const double square = angle > 1e-3 ? (1 - angle / 2 / std::tan(angle / 2)) / (angle * angle)
                                     : 1.0 / 12;  // its limit; the next term is angle² / 720
  return Eigen::Matrix3d::Identity() - cross / 2 + square * cross * cross;
}

}  // namespace

PointCost::PointCost(const PointTerm& term) : term_(&term), lens_(*term.lens) {
  set_num_residuals(int(2 * term.points_m.size()));
  mutable_parameter_block_sizes()->push_back(7);
}

bool PointCost::Evaluate(double const* const* parameters, double* residuals,
                         double** jacobians) const {
  const Eigen::Map<const Eigen::Vector3d> t(parameters[0]);
  const Eigen::Quaterniond q(parameters[0] + 3);
  const Eigen::Matrix3d rotation = q.toRotationMatrix();
  const Eigen::Matrix<double, 3, 4> step = step_by_quaternion(q);
  const bool derive = jacobians && jacobians[0];
  const double weight = 1 / term_->sigma_px;
  Eigen::Matrix<double, 2, 3> by_point;
  for (std::size_t i = 0; i < term_->points_m.size(); ++i) {
    const Eigen::Vector3d arm = rotation * term_->points_m[i];
    const Eigen::Vector2d at =
        lens_.project(term_->T_cam_ref * (arm + t), derive ? &by_point : nullptr);
    Eigen::Map<Eigen::Vector2d>(residuals + 2 * i) = weight * (at - term_->pixels[i]);
    if (!derive) continue;
    by_point = (weight * by_point * term_->T_cam_ref.rotation()).eval();
    Eigen::Map<Eigen::Matrix<double, 2, 7, Eigen::RowMajor>> rows(jacobians[0] + 14 * i);
    rows.leftCols<3>() = by_point;
    rows.rightCols<4>() = -by_point * cross_matrix(arm) * step;
  }
  return true;
}

PoseCost::PoseCost(const PoseTerm& term) : term_(&term) {
  set_num_residuals(6);
  mutable_parameter_block_sizes()->push_back(7);
}

bool PoseCost::Evaluate(double const* const* parameters, double* residuals,
                        double** jacobians) const {
  const Eigen::Map<const Eigen::Vector3d> t(parameters[0]);
  const Eigen::Quaterniond q(parameters[0] + 3);
  const Eigen::Vector3d arm = q * term_->T_body_feature.translation();
  const Eigen::Vector3d turn = log_of(q * term_->T_body_feature.quaternion() *
                                      term_->T_ref_feature.quaternion().conjugate());
  Eigen::Map<Eigen::Matrix<double, 6, 1>> off(residuals);
  off.head<3>() = (arm + t - term_->T_ref_feature.translation()) / term_->sigma_m;
  off.tail<3>() = turn / term_->sigma_rad;
  if (!jacobians || !jacobians[0]) return true;
  const Eigen::Matrix<double, 3, 4> step = step_by_quaternion(q);
  Eigen::Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> rows(jacobians[0]);
  rows.setZero();
  rows.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() / term_->sigma_m;
  rows.topRightCorner<3, 4>() = -cross_matrix(arm) * step / term_->sigma_m;
  rows.bottomRightCorner<3, 4>() = log_by_left_step(turn) * step / term_->sigma_rad;
  return true;
}

}  // namespace vantage::reconstruction::detail
