#include "hypothesis/linear_system.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "pose/rigid_motion.hpp"
#include "pose/symmetry.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr int kMaxRefinements = 25;
constexpr double kTurnSigmaRad = 10;  // a measured pose says nothing of turns around a symmetry

Eigen::Quaterniond rotation_of(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle < 1e-300) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

/// The standard deviation, per coordinate, by which the error of its camera's pose moves a point.
double camera_sigma_px(const Measurement& measurement, const Pose& T_world_object,
                       const Eigen::Vector3d& point) {
  const Matrix6d& covariance = measurement.view->covariance;
  if (covariance.isZero(0)) return 0;
  const Eigen::Vector3d p_world = T_world_object * point;
  const Eigen::Vector3d p = measurement.T_cam_world * p_world;
  if (!is_before(p)) return 0;
  Eigen::Matrix<double, 2, 3> by_point;
  measurement.lens->project(p, &by_point);
  by_point = (by_point * measurement.T_cam_world.rotation()).eval();
  const Eigen::Vector3d arm = p_world - measurement.view->T_world_cam->translation();
  Eigen::Matrix<double, 2, 6> by_camera;
  by_camera.leftCols<3>() = -by_point;
  for (int row = 0; row < 2; ++row) {
    by_camera.block<1, 3>(row, 3) = -arm.cross(by_point.row(row).transpose()).transpose();
  }
  return std::sqrt((by_camera * covariance * by_camera.transpose()).trace() / 2);
}

/// Adds a point's two residuals.
void add_point(const Measurement& measurement, const Pose& T_world_object,
               const Eigen::Vector3d& point, const Eigen::Vector2d& pixel, double weight,
               LinearSystem& system) {
  const Eigen::Vector3d turned = T_world_object.rotation() * point;
  const Eigen::Vector3d p = measurement.T_cam_world * (turned + T_world_object.translation());
  if (!is_before(p)) {
    system.in_front = false;
    return;
  }
  Eigen::Matrix<double, 2, 3> by_point;
  const Eigen::Vector2d residual = measurement.lens->project(p, &by_point) - pixel;
  Eigen::Matrix<double, 2, 6> by_pose;
  by_pose.leftCols<3>() = by_point * measurement.T_cam_world.rotation();
  for (int row = 0; row < 2; ++row) {
    by_pose.block<1, 3>(row, 3) = turned.cross(by_pose.block<1, 3>(row, 0).transpose()).transpose();
  }
  system.information.noalias() += weight * by_pose.transpose() * by_pose;
  system.gradient.noalias() += weight * by_pose.transpose() * residual;
  system.chi_square += weight * residual.squaredNorm();
  system.squared_px += residual.squaredNorm();
  ++system.points;
}

/// Takes out what the evidence says of turns around the type's axes of symmetry, nearly: with
/// nothing at all the sums would be singular.
void forget_turns(const ObjectType& type, const Pose& T_world_object, LinearSystem& system) {
  for (const ContinuousSymmetry& symmetry : type.symmetries.continuous) {
    const Vector6d along = turn_direction(symmetry, T_world_object);
    const Vector6d known = system.information * along;
    const double amount = along.dot(known);
    if (!(amount > 0)) continue;
    const double kept = 1 / (kTurnSigmaRad * kTurnSigmaRad * amount);
    system.gradient -= known * (along.dot(system.gradient) / amount);
    system.information -= (1 - kept) / amount * known * known.transpose();
  }
}

LinearSystem evidence_of_pose(const Correspondence& correspondence, const SeenPose& seen,
                              const Pose& T_world_object) {
  const Pose measured = *correspondence.measurement->view->T_world_cam * seen.T_cam_feature;
  const Pose like_measured = turned_towards(correspondence.type(), T_world_object,
                                            measured * correspondence.T_object_feature.inverse());
  const Pose expected = like_measured * correspondence.T_object_feature;
  const Eigen::Vector3d arm = expected.translation() - T_world_object.translation();
  const Matrix6d by_pose = carried_along(arm);
  Vector6d residual;
  residual.head<3>() = expected.translation() - measured.translation();
  residual.tail<3>() = rotation_vector(expected.rotation() * measured.rotation().transpose());
  Vector6d weight;
  weight.head<3>().setConstant(1 / (seen.sigma_m * seen.sigma_m));
  weight.tail<3>().setConstant(1 / (seen.sigma_rad * seen.sigma_rad));
  LinearSystem system;
  system.information = by_pose.transpose() * weight.asDiagonal() * by_pose;
  system.gradient = by_pose.transpose() * weight.asDiagonal() * residual;
  system.chi_square = residual.dot(weight.asDiagonal() * residual);
  system.points = 4;
  forget_turns(correspondence.type(), T_world_object, system);
  return system;
}

Refined summed(std::span<const Correspondence* const> correspondences, const Pose& pose,
               double min_sigma_px) {
  Refined refined{pose, {}, {}};
  refined.each.reserve(correspondences.size());
  for (const Correspondence* correspondence : correspondences) {
    refined.each.push_back(linear_system_of(*correspondence, pose, min_sigma_px));
    refined.sum.add(refined.each.back());
  }
  return refined;
}

}  // namespace

void LinearSystem::add(const LinearSystem& other) {
  information += other.information;
  gradient += other.gradient;
  chi_square += other.chi_square;
  squared_px += other.squared_px;
  points += other.points;
  in_front = in_front && other.in_front;
}

double LinearSystem::rms_px() const {
  return points > 0 ? std::sqrt(squared_px / points) : 0;
}

Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

Pose moved(const Pose& pose, const Vector6d& step) {
  return Pose::from_quaternion(rotation_of(step.tail<3>()) * pose.quaternion(),
                               pose.translation() + step.head<3>());
}

LinearSystem linear_system_of(const Correspondence& correspondence, const Pose& T_world_object,
                              double min_sigma_px, std::size_t max_points) {
  if (const SeenPose* seen = correspondence.measurement->pose()) {
    return evidence_of_pose(correspondence, *seen, T_world_object);
  }
  const SeenPoints& seen = *correspondence.measurement->points();
  const double own = std::max(seen.sigma_px, min_sigma_px);
  const double camera = min_sigma_px > 0
                            ? camera_sigma_px(*correspondence.measurement, T_world_object,
                                              correspondence.points_m.front()) /
                                  2
                            : 0;
  const double sigma = std::hypot(own, camera);
  LinearSystem system;
  const std::size_t count = std::min(correspondence.points_m.size(), max_points);
  for (std::size_t i = 0; i < count && system.in_front; ++i) {
    add_point(*correspondence.measurement, T_world_object, correspondence.points_m[i],
              seen.pixels[i], 1 / (sigma * sigma), system);
  }
  return system;
}

std::optional<Refined> refine(std::span<const Correspondence* const> correspondences,
                              const Pose& start, double min_sigma_px) {
  Refined best = summed(correspondences, start, min_sigma_px);
  if (!best.sum.in_front) return std::nullopt;
  double damping = 1e-4;
  for (int step = 0; step < kMaxRefinements && damping < 1e6; ++step) {
    Matrix6d damped = best.sum.information;
    damped.diagonal() *= 1 + damping;
    const Eigen::LDLT<Matrix6d> solver(damped);
    if (!(solver.rcond() > 1e-15)) return std::nullopt;
    const Vector6d move = -solver.solve(best.sum.gradient);
    if (!(move.norm() < 10)) return std::nullopt;  // also for NaN
    Refined next = summed(correspondences, moved(best.T_world_object, move), min_sigma_px);
    const double before = best.sum.chi_square;
    if (!next.sum.in_front || !(next.sum.chi_square <= before)) {
      damping *= 10;
      if (move.norm() < 1e-9) break;
      continue;
    }
    best = std::move(next);
    damping *= 0.1;
    if (before - best.sum.chi_square < 1e-6 * (1 + before)) break;
  }
  return best;
}

}  // namespace vantage::reconstruction::detail
