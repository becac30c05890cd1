#include "view_frustum.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/raycore/box_projector.hpp"
#include "vantage/raycore/multiversion.hpp"

namespace vantage::detail {
namespace {

struct Lanes {
  const double *x, *y, *z, *half_x, *half_y, *half_z;
};

VANTAGE_MULTIVERSION
void test_boxes(const std::array<ViewPlane, 6>& planes, const Lanes& boxes, std::size_t count,
                InView* result) {
  for (std::size_t i = 0; i < count; ++i) {
    bool outside = false, inside = true;
    for (const ViewPlane& p : planes) {
      const double middle = p.x * boxes.x[i] + p.y * boxes.y[i] + p.z * boxes.z[i] + p.offset;
      const double reach = std::fabs(p.x) * boxes.half_x[i] + std::fabs(p.y) * boxes.half_y[i] +
                           std::fabs(p.z) * boxes.half_z[i] + p.margin;
      outside |= middle + reach < 0;
      inside &= middle - reach > 0;
    }
    result[i] = outside ? InView::none : inside ? InView::all : InView::some;
  }
}

}  // namespace

ViewFrustum::ViewFrustum(const PinholeCamera& view, double largest_coordinate) {
  const Intrinsics& k = view.intrinsics();
  const DepthRange& range = view.range();
  const Eigen::Matrix3d& R = view.T_world_cam().rotation();
  const Eigen::Vector3d x = R.col(0), y = R.col(1), z = R.col(2), &eye = view.centre();
  const double margin_m = kRoundingOfRays * std::max(largest_coordinate, eye.cwiseAbs().maxCoeff());
  const auto plane = [&](const Eigen::Vector3d& inwards, double offset) -> ViewPlane {
    return {inwards.x(), inwards.y(), inwards.z(), offset - inwards.dot(eye),
            margin_m * inwards.lpNorm<1>()};
  };
  planes_ = {plane(z, -range.near_m),
             plane(-z, range.far_m),
             plane(k.fx * x + (k.cx + 0.5) * z, 0),
             plane(-k.fx * x - (k.cx + 0.5 - k.width) * z, 0),
             plane(k.fy * y + (k.cy + 0.5) * z, 0),
             plane(-k.fy * y - (k.cy + 0.5 - k.height) * z, 0)};
}

void ViewFrustum::test(const BoxLanes& boxes, std::size_t first, std::size_t count,
                       InView* result) const {
  const Lanes lanes{&boxes.centre_x[first], &boxes.centre_y[first], &boxes.centre_z[first],
                    &boxes.half_x[first],   &boxes.half_y[first],   &boxes.half_z[first]};
  test_boxes(planes_, lanes, count, result);
}

}  // namespace vantage::detail
