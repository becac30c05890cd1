#include "vantage/raycore/detail/box_projector.hpp"

#include <algorithm>
#include <limits>

namespace vantage {
namespace {

/// Smallest and largest value of a linear function over a box.
struct Span {
  double low, high;
};
Span span_of(const Eigen::Vector3d& gradient, const Eigen::Vector3d& centre,
             const Eigen::Vector3d& half) {
  const double middle = gradient.dot(centre), reach = gradient.cwiseAbs().dot(half);
  return {middle - reach, middle + reach};
}

}  // namespace

BoxProjector::BoxProjector(const PinholeCamera& camera)
    : camera_(camera), R_cam_world_(camera.T_world_cam().rotation().transpose()) {}

double BoxProjector::margin_m(const Extent& box) const {
  const double corner = (box.centre.cwiseAbs() + box.half).maxCoeff();
  return kRoundingOfRays * std::max(corner, camera_.centre().cwiseAbs().maxCoeff());
}

BoxInView BoxProjector::project(const Extent& box, double margin_m) const {
  const Intrinsics& k = camera_.intrinsics();
  const DepthRange& range = camera_.range();
  const Eigen::Vector3d centre = box.centre - camera_.centre();
  const Eigen::Vector3d half = box.half.array() + margin_m;
  const Eigen::Vector3d x = R_cam_world_.row(0), y = R_cam_world_.row(1), z = R_cam_world_.row(2);

  // The image's borders as planes through the camera's centre, as in PinholeCamera::in_view.
  const Span depth = span_of(z, centre, half);
  const Span left = span_of(k.fx * x + (k.cx + 0.5) * z, centre, half);
  const Span right = span_of(k.fx * x + (k.cx + 0.5 - k.width) * z, centre, half);
  const Span top = span_of(k.fy * y + (k.cy + 0.5) * z, centre, half);
  const Span bottom = span_of(k.fy * y + (k.cy + 0.5 - k.height) * z, centre, half);

  BoxInView view{Coverage::some, depth.low, depth.high, {}};
  if (depth.high < range.near_m || depth.low > range.far_m || left.high < 0 || right.low > 0 ||
      top.high < 0 || bottom.low > 0) {
    view.coverage = Coverage::none;
    return view;
  }
  if (depth.low > range.near_m && depth.high < range.far_m && left.low > 0 && right.high < 0 &&
      top.low > 0 && bottom.high < 0) {
    view.coverage = Coverage::all;
  }
  view.rect = {-0.5, k.width - 0.5, -0.5, k.height - 0.5};
  if (depth.low <= 0.1 * range.near_m) return view;  // too close to project
  double u0 = std::numeric_limits<double>::max(), u1 = -u0, v0 = u0, v1 = -u0;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d signs((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1,
                                (corner & 4) != 0 ? 1 : -1);
    const Eigen::Vector3d p = centre + signs.cwiseProduct(half);
    const double inverse = 1 / z.dot(p);
    const double u = k.fx * x.dot(p) * inverse + k.cx, v = k.fy * y.dot(p) * inverse + k.cy;
    u0 = std::min(u0, u), u1 = std::max(u1, u), v0 = std::min(v0, v), v1 = std::max(v1, v);
  }
  view.rect = {std::max(view.rect.u0, u0), std::min(view.rect.u1, u1), std::max(view.rect.v0, v0),
               std::min(view.rect.v1, v1)};
  return view;
}

}  // namespace vantage
