#include "pose/principal_axes.hpp"

#include <Eigen/Eigenvalues>

namespace vantage::reconstruction::detail {

PrincipalAxes principal_axes(std::span<const Eigen::Vector3d> points) {
  const double share = 1 / double(points.size());
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points) centre += share * p;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points) {
    scatter += share * (p - centre) * (p - centre).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(scatter);
  Eigen::Matrix3d axes = solver.eigenvectors().rowwise().reverse();  // the solver's values rise
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return {centre, axes, solver.eigenvalues().reverse().cwiseMax(0).cwiseSqrt()};
}

}  // namespace vantage::reconstruction::detail
