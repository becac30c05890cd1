#include "pose/extrapolated_lens.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kNearest = 1e-3;  // metres before the camera
constexpr int kSteps = 4;          // from the principal point to a pixel
constexpr double kNearAxis = 1e-9;

}  // namespace

bool is_before(const Eigen::Vector3d& p_cam) {
  return p_cam.z() > kNearest;
}

Eigen::Vector2d sight_of(const Lens& lens, const Eigen::Vector2d& pixel) {
  const Intrinsics& k = lens.intrinsics();
  const Eigen::Vector2d centre(k.cx, k.cy), focal(k.fx, k.fy);
  if (lens.distortion().none()) return (pixel - centre).cwiseQuotient(focal);
  // In steps, as Newton's method could jump over a fold.
  Eigen::Vector2d xy = Eigen::Vector2d::Zero();
  for (int step = 1; step <= kSteps; ++step) {
    const Eigen::Vector2d at = centre + (pixel - centre) * step / kSteps;
    xy = lens.sight(at.x(), at.y(), xy).xy;
  }
  return xy;
}

Eigen::Vector2d WideLens::distort(const Eigen::Vector2d& xy, Eigen::Matrix2d* slope) const {
  if (lens_->distortion().none()) {
    if (slope) slope->setIdentity();
    return xy;
  }
  const double r = xy.norm(), reach = lens_->reach();
  if (r <= reach) {
    if (slope) *slope = lens_->slope(xy);
    return lens_->distort(xy);
  }
  const Eigen::Vector2d outwards = xy / r, border = outwards * reach;
  if (slope) {
    const Eigen::Matrix2d I = Eigen::Matrix2d::Identity();
    const Eigen::Matrix2d border_by_xy = reach / r * (I - outwards * outwards.transpose());
    *slope = I + (lens_->slope(border) - I) * border_by_xy;
  }
  return xy + lens_->distort(border) - border;
}

/// How far a fisheye image goes on for a point at the angle t off the axis: as at its border.
Eigen::Vector2d WideLens::project_beyond(const Eigen::Vector3d& p_cam,
                                         Eigen::Matrix<double, 2, 3>* by_point) const {
  const double reach = lens_->reach(), z = p_cam.z();
  const double off_axis = std::max(p_cam.head<2>().norm(), kNearAxis);
  const Eigen::Vector2d outwards =
      p_cam.head<2>().norm() < kNearAxis ? Eigen::Vector2d::UnitX() : p_cam.head<2>().normalized();
  const double by_angle =
      outwards.dot(lens_->slope(outwards * reach) * outwards) * (1 + reach * reach);
  const double radius = lens_->distort(outwards * reach).norm() +
                        (std::atan2(off_axis, z) - std::atan(reach)) * by_angle;
  if (by_point) {
    const double square = off_axis * off_axis + z * z;
    const Eigen::Matrix2d along = outwards * outwards.transpose();
    by_point->leftCols<2>() =
        radius / off_axis * (Eigen::Matrix2d::Identity() - along) + by_angle * z / square * along;
    by_point->col(2) = -by_angle * off_axis / square * outwards;
  }
  return radius * outwards;
}

Eigen::Vector2d WideLens::to_pixel(const Eigen::Vector2d& xy) const {
  const Intrinsics& k = lens_->intrinsics();
  return {k.fx * xy.x() + k.cx, k.fy * xy.y() + k.cy};
}

Eigen::Vector2d WideLens::project(const Eigen::Vector3d& p_cam,
                                  Eigen::Matrix<double, 2, 3>* by_point) const {
  const Eigen::Vector2d focal(lens_->intrinsics().fx, lens_->intrinsics().fy);
  const bool is_fisheye = lens_->distortion().model == LensModel::fisheye;
  if (is_fisheye && !(p_cam.head<2>().norm() < lens_->reach() * p_cam.z())) {
    const Eigen::Vector2d xy = project_beyond(p_cam, by_point);
    if (by_point) *by_point = (focal.asDiagonal() * *by_point).eval();
    return to_pixel(xy);
  }
  const bool before = is_fisheye || is_before(p_cam);
  const double over_z = before ? 1 / p_cam.z() : (2 * kNearest - p_cam.z()) / (kNearest * kNearest);
  Eigen::Matrix2d slope;
  const Eigen::Vector2d xy = distort(p_cam.head<2>() * over_z, by_point ? &slope : nullptr);
  if (by_point) {
    const double by_z = before ? -over_z * over_z : -1 / (kNearest * kNearest);
    slope = (focal.asDiagonal() * slope).eval();
    by_point->leftCols<2>() = slope * over_z;
    by_point->col(2) = slope * p_cam.head<2>() * by_z;
  }
  return to_pixel(xy);
}

}  // namespace vantage::reconstruction::detail
