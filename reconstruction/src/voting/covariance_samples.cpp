#include "voting/covariance_samples.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "hypothesis/linear_system.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kWorthSpreading = 0.5, kFarthest = 2;  // cells
const double kOut = std::sqrt(1.5);                     // three equal weights with a variance of 1

Vector6d difference(const Pose& from, const Pose& to) {
  Vector6d step;
  step << to.translation() - from.translation(),
      rotation_vector(to.rotation() * from.rotation().transpose());
  return step;
}

/// Steps from the middle along the axes of the covariance that are worth it, the longest first.
std::vector<Vector6d> long_axes(const Matrix6d& covariance, const VoteGrid& grid) {
  Vector6d cell;
  cell << Eigen::Vector3d::Constant(grid.cell_m), Eigen::Vector3d::Constant(grid.cell_rad);
  const Matrix6d in_cells =
      cell.cwiseInverse().asDiagonal() * covariance * cell.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> solver(in_cells);
  std::vector<Vector6d> axes;
  for (int i = 5; i >= 4; --i) {
    const double sigma = std::sqrt(std::max(solver.eigenvalues()[i], 0.0));
    if (!(sigma > kWorthSpreading)) break;
    axes.push_back(kOut * std::min(sigma, kFarthest) *
                   cell.cwiseProduct(Vector6d(solver.eigenvectors().col(i))));
  }
  return axes;
}

}  // namespace

VotePlace place_of(const ObjectType& type, std::uint32_t rank, const Pose& T_world_object) {
  const auto& axes = type.symmetries.continuous;
  if (axes.empty()) {
    return {rank, T_world_object.translation(), 2 * T_world_object.quaternion().coeffs(), true};
  }
  VotePlace place{rank, T_world_object * axes.front().offset_m, Eigen::Vector4d::Zero(), false};
  const bool one_axis = std::all_of(axes.begin(), axes.end(), [&](const ContinuousSymmetry& other) {
    return other.axis.cross(axes.front().axis).norm() < 1e-6;
  });
  if (one_axis) place.turn.head<3>() = T_world_object.rotation() * axes.front().axis;
  return place;
}

std::vector<Pose> spread(const Pose& pose, const Matrix6d& covariance, const VoteGrid& grid) {
  std::vector<Vector6d> steps = {Vector6d::Zero()};
  for (const Vector6d& axis : long_axes(covariance, grid)) {
    const std::size_t so_far = steps.size();
    for (std::size_t i = 0; i < so_far; ++i) {
      steps.push_back(steps[i] + axis);
      steps.push_back(steps[i] - axis);
    }
  }
  std::vector<Pose> poses;
  for (const Vector6d& step : steps) poses.push_back(moved(pose, step));
  return poses;
}

double squared_distance(const Pose& a, const Matrix6d& covariance_a, const Pose& b,
                        const Matrix6d& covariance_b) {
  const Vector6d step = difference(a, b);
  const Matrix6d both = covariance_a + covariance_b;
  return step.dot(both.ldlt().solve(step));
}

}  // namespace vantage::reconstruction::detail
