#include "hypothesis/linear_system.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "pose/rigid_motion.hpp"
#include "pose/symmetry.hpp"

namespace vantage::detail {
namespace {

constexpr int kMostRefinements = 25;
constexpr double kTurnSigmaRad = 10;  // a measured pose says nothing of turns around a symmetry

Eigen::Quaterniond rotation_of(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle < 1e-300) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

/// The standard deviation, per coordinate, by which the error of its camera's pose moves a point.
double camera_sigma_px(const Sighting& sighting, const Pose& T_world_object,
                       const Eigen::Vector3d& point) {
  const Matrix6d& covariance = sighting.view->covariance;
  if (covariance.isZero(0)) return 0;
  const Eigen::Vector3d p_world = T_world_object * point;
  const Eigen::Vector3d p = sighting.T_cam_world * p_world;
  if (!is_before(p)) return 0;
  Eigen::Matrix<double, 2, 3> by_point;
  sighting.lens->project(p, &by_point);
  by_point = (by_point * sighting.T_cam_world.rotation()).eval();
  const Eigen::Vector3d arm = p_world - sighting.view->T_world_cam->translation();
  Eigen::Matrix<double, 2, 6> by_camera;
  by_camera.leftCols<3>() = -by_point;
  for (int row = 0; row < 2; ++row) {
    by_camera.block<1, 3>(row, 3) = -arm.cross(by_point.row(row).transpose()).transpose();
  }
  return std::sqrt((by_camera * covariance * by_camera.transpose()).trace() / 2);
}

/// Adds a point's two residuals.
void add_point(const Sighting& sighting, const Pose& T_world_object, const Eigen::Vector3d& point,
               const Eigen::Vector2d& pixel, double weight, Evidence& evidence) {
  const Eigen::Vector3d turned = T_world_object.rotation() * point;
  const Eigen::Vector3d p = sighting.T_cam_world * (turned + T_world_object.translation());
  if (!is_before(p)) {
    evidence.in_front = false;
    return;
  }
  Eigen::Matrix<double, 2, 3> by_point;
  const Eigen::Vector2d residual = sighting.lens->project(p, &by_point) - pixel;
  Eigen::Matrix<double, 2, 6> by_pose;
  by_pose.leftCols<3>() = by_point * sighting.T_cam_world.rotation();
  for (int row = 0; row < 2; ++row) {
    by_pose.block<1, 3>(row, 3) = turned.cross(by_pose.block<1, 3>(row, 0).transpose()).transpose();
  }
  evidence.information.noalias() += weight * by_pose.transpose() * by_pose;
  evidence.slope.noalias() += weight * by_pose.transpose() * residual;
  evidence.chi_square += weight * residual.squaredNorm();
  evidence.squared_px += residual.squaredNorm();
  ++evidence.points;
}

/// Takes out what the evidence says of turns around the type's axes of symmetry, nearly: with
/// nothing at all the sums would be singular.
void forget_turns(const ObjectType& type, const Pose& T_world_object, Evidence& evidence) {
  for (const ContinuousSymmetry& symmetry : type.symmetries.continuous) {
    const Vector6d along = turn_direction(symmetry, T_world_object);
    const Vector6d known = evidence.information * along;
    const double amount = along.dot(known);
    if (!(amount > 0)) continue;
    const double kept = 1 / (kTurnSigmaRad * kTurnSigmaRad * amount);
    evidence.slope -= known * (along.dot(evidence.slope) / amount);
    evidence.information -= (1 - kept) / amount * known * known.transpose();
  }
}

Evidence evidence_of_pose(const Reading& reading, const SeenPose& seen,
                          const Pose& T_world_object) {
  const Pose measured = *reading.sighting->view->T_world_cam * seen.T_cam_feature;
  const Pose like_measured =
      turned_towards(reading.type(), T_world_object, measured * reading.T_object_feature.inverse());
  const Pose expected = like_measured * reading.T_object_feature;
  const Eigen::Vector3d arm = expected.translation() - T_world_object.translation();
  const Matrix6d by_pose = carried_along(arm);
  Vector6d residual;
  residual.head<3>() = expected.translation() - measured.translation();
  residual.tail<3>() = rotation_vector(expected.rotation() * measured.rotation().transpose());
  Vector6d weight;
  weight.head<3>().setConstant(1 / (seen.sigma_m * seen.sigma_m));
  weight.tail<3>().setConstant(1 / (seen.sigma_rad * seen.sigma_rad));
  Evidence evidence;
  evidence.information = by_pose.transpose() * weight.asDiagonal() * by_pose;
  evidence.slope = by_pose.transpose() * weight.asDiagonal() * residual;
  evidence.chi_square = residual.dot(weight.asDiagonal() * residual);
  evidence.points = 4;
  forget_turns(reading.type(), T_world_object, evidence);
  return evidence;
}

Refined summed(std::span<const Reading* const> readings, const Pose& pose, double least_sigma_px) {
  Refined refined{pose, {}, {}};
  refined.each.reserve(readings.size());
  for (const Reading* reading : readings) {
    refined.each.push_back(evidence_of(*reading, pose, least_sigma_px));
    refined.sum.add(refined.each.back());
  }
  return refined;
}

}  // namespace

void Evidence::add(const Evidence& other) {
  information += other.information;
  slope += other.slope;
  chi_square += other.chi_square;
  squared_px += other.squared_px;
  points += other.points;
  in_front = in_front && other.in_front;
}

double Evidence::rms_px() const {
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

Evidence evidence_of(const Reading& reading, const Pose& T_world_object, double least_sigma_px,
                     std::size_t most_points) {
  if (const SeenPose* seen = reading.sighting->pose()) {
    return evidence_of_pose(reading, *seen, T_world_object);
  }
  const SeenPoints& seen = *reading.sighting->points();
  const double own = std::max(seen.sigma_px, least_sigma_px);
  const double camera =
      least_sigma_px > 0
          ? camera_sigma_px(*reading.sighting, T_world_object, reading.points_m.front()) / 2
          : 0;
  const double sigma = std::hypot(own, camera);
  Evidence evidence;
  const std::size_t count = std::min(reading.points_m.size(), most_points);
  for (std::size_t i = 0; i < count && evidence.in_front; ++i) {
    add_point(*reading.sighting, T_world_object, reading.points_m[i], seen.pixels[i],
              1 / (sigma * sigma), evidence);
  }
  return evidence;
}

std::optional<Refined> refine(std::span<const Reading* const> readings, const Pose& start,
                              double least_sigma_px) {
  Refined best = summed(readings, start, least_sigma_px);
  if (!best.sum.in_front) return std::nullopt;
  double damping = 1e-4;
  for (int step = 0; step < kMostRefinements && damping < 1e6; ++step) {
    Matrix6d damped = best.sum.information;
    damped.diagonal() *= 1 + damping;
    const Eigen::LDLT<Matrix6d> solver(damped);
    if (!(solver.rcond() > 1e-15)) return std::nullopt;
    const Vector6d move = -solver.solve(best.sum.slope);
    if (!(move.norm() < 10)) return std::nullopt;  // also for NaN
    Refined next = summed(readings, moved(best.T_world_object, move), least_sigma_px);
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

}  // namespace vantage::detail
