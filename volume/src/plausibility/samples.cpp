#include "plausibility/samples.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage::volume::detail {
namespace {

constexpr int kCells = 9;
constexpr int kPixelsAcross = 96;  ///< about, along the longer side

/// Where the ray crosses the box (slab by slab).
std::optional<DepthSpan> span_in(const Box& box, const PixelRay& ray) {
  double enter = 0, exit = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = ray.origin[axis], step = ray.direction[axis];
    if (step == 0) {
      if (origin < box.min()[axis] || origin > box.max()[axis]) return std::nullopt;
      continue;
    }
    const double a = (box.min()[axis] - origin) / step, b = (box.max()[axis] - origin) / step;
    enter = std::max(enter, std::min(a, b));
    exit = std::min(exit, std::max(a, b));
  }
  if (!(enter < exit)) return std::nullopt;
  return DepthSpan{enter, exit};
}

}  // namespace

std::vector<Eigen::Vector3d> area_samples(const Box& work_area) {
  std::vector<Eigen::Vector3d> points;
  for (int z = 0; z < kCells; ++z) {
    for (int y = 0; y < kCells; ++y) {
      for (int x = 0; x < kCells; ++x) {
        const Eigen::Vector3d at = (Eigen::Vector3d(x, y, z).array() + 0.5) / kCells;
        points.emplace_back(work_area.min() + at.cwiseProduct(work_area.size()));
      }
    }
  }
  return points;
}

double coverage_of(const PinholeCamera& camera, const std::vector<Eigen::Vector3d>& points) {
  const Intrinsics& k = camera.intrinsics();
  const auto seen = std::ranges::count_if(points, [&](const Eigen::Vector3d& point) {
    const auto pixel = camera.project(point);
    return pixel && pixel->u >= -0.5 && pixel->u < k.width - 0.5 && pixel->v >= -0.5 &&
           pixel->v < k.height - 0.5;
  });
  return double(seen) / double(points.size());
}

std::vector<DepthSample> depth_samples(const DepthCamera& camera, const Box& work_area) {
  std::vector<DepthSample> samples;
  if (camera.depth == nullptr) return samples;
  const DepthImage& depth = *camera.depth;
  const int step = std::max(1, std::max(depth.width(), depth.height()) / kPixelsAcross);
  for (int v = step / 2; v < depth.height(); v += step) {
    for (int u = step / 2; u < depth.width(); u += step) {
      const float depth_m = depth.at(u, v);
      if (std::isnan(depth_m)) continue;
      samples.push_back({u, v, double(depth_m), span_in(work_area, camera.camera.pixel_ray(u, v))});
    }
  }
  return samples;
}

Box grown(const Box& box, double share) {
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(share * box.size().norm());
  return Box(box.min() - margin, box.max() + margin);
}

}  // namespace vantage::volume::detail
