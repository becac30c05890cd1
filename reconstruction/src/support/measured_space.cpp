#include <algorithm>
#include <cmath>

#include "vantage/reconstruction/support.hpp"

namespace vantage {
namespace {

/// Depths that differ by less may be the same surface.
double same_surface_m(double depth_m) {
  return std::max(0.01, 0.015 * depth_m);
}

SpaceState state_by(const DepthCamera& depth, const Eigen::Vector3d& p_world) {
  const std::optional<ImagePoint> at = depth.camera.project(p_world);
  if (!at) return SpaceState::unseen;
  const double u = std::round(at->u), v = std::round(at->v);
  const DepthImage& image = *depth.depth;
  if (!(u >= 0 && v >= 0 && u < image.width() && v < image.height())) return SpaceState::unseen;
  const DepthRange& range = depth.camera.range();
  const double measured = double(image.at(int(u), int(v)));
  if (at->depth < range.near_m || at->depth > range.far_m || !(measured >= range.near_m)) {
    return SpaceState::unseen;
  }
  const double behind = measured - at->depth;
  if (behind < -same_surface_m(at->depth)) return SpaceState::unseen;
  return behind > same_surface_m(at->depth) ? SpaceState::empty : SpaceState::occupied;
}

}  // namespace

SpaceProbe measured_space(std::vector<DepthCamera> cameras) {
  std::erase_if(cameras, [](const DepthCamera& camera) { return camera.depth == nullptr; });
  if (cameras.empty()) return {};
  return [cameras = std::move(cameras)](const Eigen::Vector3d& p_world) {
    SpaceState state = SpaceState::unseen;
    for (const DepthCamera& camera : cameras) {
      const SpaceState seen = state_by(camera, p_world);
      if (seen == SpaceState::empty) return seen;
      if (seen == SpaceState::occupied) state = seen;
    }
    return state;
  };
}

}  // namespace vantage
