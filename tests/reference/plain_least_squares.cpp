#include "reference/plain_least_squares.hpp"

#include <Eigen/QR>

namespace vantage::test {

Pose moved_by(const Pose& pose, const Eigen::Matrix<double, 6, 1>& step) {
  const Eigen::Vector3d r = step.tail<3>();
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(r.norm(), r.stableNormalized()).toRotationMatrix();
  return Pose::from_rotation(turn * pose.rotation(), pose.translation() + step.head<3>());
}

Eigen::Matrix<double, 6, 1> step_between(const Pose& from, const Pose& to) {
  const Eigen::AngleAxisd turn(Eigen::Quaterniond(to.rotation() * from.rotation().transpose()));
  Eigen::Matrix<double, 6, 1> step;
  step << to.translation() - from.translation(), turn.angle() * turn.axis();
  return step;
}

Eigen::Matrix<double, Eigen::Dynamic, 6> numeric_derivatives(const ResidualsOfPose& residuals,
                                                             const Pose& pose) {
  constexpr double kStep = 1e-6;
  Eigen::Matrix<double, Eigen::Dynamic, 6> result(residuals(pose).size(), 6);
  for (int i = 0; i < 6; ++i) {
    const Eigen::Matrix<double, 6, 1> step = kStep * Eigen::Matrix<double, 6, 1>::Unit(i);
    result.col(i) =
        (residuals(moved_by(pose, step)) - residuals(moved_by(pose, -step))) / (2 * kStep);
  }
  return result;
}

Pose plain_minimum(const ResidualsOfPose& residuals, const Pose& start) {
  Pose pose = start;
  for (int round = 0; round < 200; ++round) {
    const Eigen::VectorXd r = residuals(pose);
    Eigen::Matrix<double, 6, 1> step =
        -numeric_derivatives(residuals, pose).colPivHouseholderQr().solve(r);
    while (step.norm() > 1e-13 && residuals(moved_by(pose, step)).squaredNorm() > r.squaredNorm()) {
      step /= 2;
    }
    pose = moved_by(pose, step);
    if (step.norm() < 1e-12) break;
  }
  return pose;
}

}  // namespace vantage::test
