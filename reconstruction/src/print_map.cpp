#include "print_map.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace vantage::detail {

std::optional<Eigen::Vector2d> PrintMap::at(const Eigen::Vector2d& print) const {
  const Eigen::Vector3d p = h * print.homogeneous();
  if (!(p.z() > 0)) return std::nullopt;
  return p.hnormalized();
}

Eigen::Matrix2d PrintMap::slope(const Eigen::Vector2d& print) const {
  const Eigen::Vector3d p = h * print.homogeneous();
  return (h.topLeftCorner<2, 2>() - p.hnormalized() * h.bottomLeftCorner<1, 2>()) / p.z();
}

Eigen::Matrix<double, 2, 8> PrintMap::slope_by_entries(const Eigen::Vector2d& print) const {
  const Eigen::Vector3d p = h * print.homogeneous();
  const Eigen::Vector2d pixel = p.hnormalized();
  Eigen::Matrix<double, 2, 8> slope = Eigen::Matrix<double, 2, 8>::Zero();
  slope.block<1, 3>(0, 0) = print.homogeneous().transpose();
  slope.block<1, 3>(1, 3) = print.homogeneous().transpose();
  slope.block<2, 2>(0, 6) = -pixel * print.transpose();
  return slope / p.z();
}

std::optional<PrintMap> print_map(const std::array<Eigen::Vector2d, 4>& pixels) {
  Eigen::Matrix<double, 8, 8> equations = Eigen::Matrix<double, 8, 8>::Zero();
  Eigen::Matrix<double, 8, 1> right;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d& print = kPrintCorners[std::size_t(i)];
    const Eigen::Vector2d& pixel = pixels[std::size_t(i)];
    equations.block<1, 3>(2 * i, 0) = print.homogeneous().transpose();
    equations.block<1, 3>(2 * i + 1, 3) = print.homogeneous().transpose();
    equations.block<2, 2>(2 * i, 6) = -pixel * print.transpose();
    right.segment<2>(2 * i) = pixel;
  }
  const Eigen::FullPivLU<Eigen::Matrix<double, 8, 8>> lu(equations);
  if (!lu.isInvertible()) return std::nullopt;
  const Eigen::Matrix<double, 8, 1> entries = lu.solve(right);
  PrintMap map;
  map.h << entries.head<3>().transpose(), entries.segment<3>(3).transpose(),
      entries.tail<2>().transpose(), 1;
  return map;
}

}  // namespace vantage::detail
