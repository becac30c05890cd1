#include "markers/marker_homography.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

Eigen::Vector2d seen(const Lens* lens, const Eigen::Vector2d& flat) {
  return lens ? lens->project(flat.homogeneous()) : flat;
}

Eigen::Matrix2d slope_of(const Lens* lens, const Eigen::Vector2d& flat) {
  if (!lens) return Eigen::Matrix2d::Identity();
  const Intrinsics& k = lens->intrinsics();
  return Eigen::Vector2d(k.fx, k.fy).asDiagonal() * lens->slope(flat);
}

/// Nothing for a pixel that the lens has no direction for.
std::optional<Eigen::Vector2d> unseen(const Lens* lens, const Eigen::Vector2d& pixel) {
  if (!lens) return pixel;
  const Intrinsics& k = lens->intrinsics();
  const Eigen::Vector2d guess((pixel.x() - k.cx) / k.fx, (pixel.y() - k.cy) / k.fy);
  try {
    return lens->sight(pixel.x(), pixel.y(), guess).xy;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

std::optional<Eigen::Vector2d> PrintMap::at(const Eigen::Vector2d& print) const {
  const Eigen::Vector3d p = h * print.homogeneous();
  if (!(p.z() > 0)) return std::nullopt;
  return seen(lens, p.hnormalized());
}

Eigen::Matrix2d PrintMap::slope(const Eigen::Vector2d& print) const {
  const Eigen::Vector3d p = h * print.homogeneous();
  const Eigen::Vector2d flat = p.hnormalized();
  return slope_of(lens, flat) * (h.topLeftCorner<2, 2>() - flat * h.bottomLeftCorner<1, 2>()) /
         p.z();
}

Eigen::Matrix<double, 2, 8> PrintMap::slope_by_entries(const Eigen::Vector2d& print) const {
  const Eigen::Vector3d p = h * print.homogeneous();
  const Eigen::Vector2d flat = p.hnormalized();
  Eigen::Matrix<double, 2, 8> slope = Eigen::Matrix<double, 2, 8>::Zero();
  slope.block<1, 3>(0, 0) = print.homogeneous().transpose();
  slope.block<1, 3>(1, 3) = print.homogeneous().transpose();
  slope.block<2, 2>(0, 6) = -flat * print.transpose();
  return slope_of(lens, flat) * slope / p.z();
}

std::optional<PrintMap> print_map(const std::array<Eigen::Vector2d, 4>& pixels, const Lens* lens) {
  Eigen::Matrix<double, 8, 8> equations = Eigen::Matrix<double, 8, 8>::Zero();
  Eigen::Matrix<double, 8, 1> right;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d& print = kPrintCorners[std::size_t(i)];
    const std::optional<Eigen::Vector2d> seen_at = unseen(lens, pixels[std::size_t(i)]);
    if (!seen_at) return std::nullopt;
    const Eigen::Vector2d& flat = *seen_at;
    equations.block<1, 3>(2 * i, 0) = print.homogeneous().transpose();
    equations.block<1, 3>(2 * i + 1, 3) = print.homogeneous().transpose();
    equations.block<2, 2>(2 * i, 6) = -flat * print.transpose();
    right.segment<2>(2 * i) = flat;
  }
  const Eigen::FullPivLU<Eigen::Matrix<double, 8, 8>> lu(equations);
  if (!lu.isInvertible()) return std::nullopt;
  const Eigen::Matrix<double, 8, 1> entries = lu.solve(right);
  PrintMap map{Eigen::Matrix3d(), lens};
  map.h << entries.head<3>().transpose(), entries.segment<3>(3).transpose(),
      entries.tail<2>().transpose(), 1;
  return map;
}

}  // namespace vantage::reconstruction::detail
