#include "scoring/voxel/view_frustum.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/raycore/detail/box_projector.hpp"
#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage::planner::detail {
namespace {

struct Lanes {
  const double *x, *y, *z, *half_x, *half_y, *half_z;
};

/// For each of eight boxes, how far its deepest corner and its least deep one are inside, at the
/// plane where that is least.
[[gnu::always_inline]] inline void depths_inside_body(const std::array<ViewPlane, 6>& planes,
                                                      const Lanes& boxes,
                                                      double* __restrict deepest,
                                                      double* __restrict least) {
  for (std::size_t i = 0; i < kBlocksPerParent; ++i) deepest[i] = least[i] = 1e300;
  for (const ViewPlane& p : planes) {
    const double ax = std::fabs(p.x), ay = std::fabs(p.y), az = std::fabs(p.z);
    for (std::size_t i = 0; i < kBlocksPerParent; ++i) {
      const double middle = p.x * boxes.x[i] + p.y * boxes.y[i] + p.z * boxes.z[i] + p.offset;
      const double reach =
          ax * boxes.half_x[i] + ay * boxes.half_y[i] + az * boxes.half_z[i] + p.margin;
      const double high = middle + reach, low = middle - reach;
      deepest[i] = high < deepest[i] ? high : deepest[i];
      least[i] = low < least[i] ? low : least[i];
    }
  }
}
constexpr Multiversion<depths_inside_body> depths_inside;

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

std::array<InView, kBlocksPerParent> ViewFrustum::test(const BoxLanes& boxes,
                                                       std::size_t first) const {
  const Lanes lanes{&boxes.centre_x[first], &boxes.centre_y[first], &boxes.centre_z[first],
                    &boxes.half_x[first],   &boxes.half_y[first],   &boxes.half_z[first]};
  std::array<double, kBlocksPerParent> deepest, least;
  depths_inside(planes_, lanes, deepest.data(), least.data());
  std::array<InView, kBlocksPerParent> result;
  for (std::size_t i = 0; i < kBlocksPerParent; ++i) {
    result[i] = deepest[i] < 0 ? InView::none : least[i] > 0 ? InView::all : InView::some;
  }
  return result;
}

}  // namespace vantage::planner::detail
