#include "pose/kabsch.hpp"

#include <Eigen/SVD>

namespace vantage::reconstruction::detail {
namespace {

constexpr double kCollinear = 1e-9;  // second singular value over the first, for collinear points

Eigen::Vector3d centroid(std::span<const Eigen::Vector3d> points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / double(points.size());
}

}  // namespace

std::optional<Pose> kabsch(std::span<const Eigen::Vector3d> from,
                           std::span<const Eigen::Vector3d> to) {
  if (from.size() < 3 || from.size() != to.size()) return std::nullopt;
  const Eigen::Vector3d c_from = centroid(from), c_to = centroid(to);
  Eigen::Matrix3d h = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < from.size(); ++i) {
    h += (from[i] - c_from) * (to[i] - c_to).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(h, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& s = svd.singularValues();
  if (!(s[1] > kCollinear * s[0])) return std::nullopt;  // also for NaN
  const Eigen::Matrix3d& u = svd.matrixU();
  const Eigen::Matrix3d& v = svd.matrixV();
  const double sign = (v * u.transpose()).determinant() < 0 ? -1 : 1;
  const Eigen::Matrix3d rotation = v * Eigen::Vector3d(1, 1, sign).asDiagonal() * u.transpose();
  return Pose::from_rotation(rotation, c_to - rotation * c_from);
}

}  // namespace vantage::reconstruction::detail
