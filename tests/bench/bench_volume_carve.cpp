#include "bench_volume_carve.hpp"

#include <algorithm>
#include <cmath>

namespace vantage::bench {
namespace {

std::size_t index(const GridGeometry& geometry, const Eigen::Vector3i& voxel) {
  const Eigen::Vector3i& n = geometry.size();
  return std::size_t((voxel.x() * n.y() + voxel.y()) * n.z() + voxel.z());
}

/// The world to camera transform and the image in float.
struct Projection {
  Eigen::Matrix3f rotation;
  Eigen::Vector3f centre;
  float fx, fy, cx, cy, near_m, far_m;

  explicit Projection(const PinholeCamera& camera)
      : rotation(camera.T_world_cam().rotation().transpose().cast<float>()),
        centre(camera.centre().cast<float>()),
        fx(float(camera.intrinsics().fx)),
        fy(float(camera.intrinsics().fy)),
        cx(float(camera.intrinsics().cx)),
        cy(float(camera.intrinsics().cy)),
        near_m(float(camera.range().near_m)),
        far_m(float(camera.range().far_m)) {}

  bool in_range(float depth) const { return depth >= near_m && depth <= far_m; }
};

void mark_points(const Projection& c, const DepthImage& depth, const GridGeometry& geometry,
                 std::vector<VoxelState>& labels) {
  const Eigen::Matrix3f back = c.rotation.transpose();
  const Eigen::Vector3f origin = geometry.origin().cast<float>();
  const float per_metre = float(1 / geometry.voxel_size_m());
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const float d = depth.at(u, v);
      if (!c.in_range(d)) continue;
      const Eigen::Vector3f p_cam((float(u) - c.cx) / c.fx * d, (float(v) - c.cy) / c.fy * d, d);
      const Eigen::Vector3f p = (back * p_cam + c.centre - origin) * per_metre;
      const Eigen::Vector3i voxel = p.array().floor().cast<int>();
      if (geometry.contains(voxel)) labels[index(geometry, voxel)] = VoxelState::occupied;
    }
  }
}

}  // namespace

std::vector<VoxelState> carve(const DepthCamera& observer, const GridGeometry& geometry,
                              const VolumeOptions& options) {
  const Projection c(observer.camera);
  const DepthImage& depth = *observer.depth;
  const float voxel_size = float(geometry.voxel_size_m());
  const float sigmas = float(options.band_sigmas * options.noise.sigma_m(1));  // at 1 m
  std::vector<VoxelState> labels(geometry.voxel_count(), VoxelState::shadow);
  mark_points(c, depth, geometry, labels);
  const Eigen::Vector3f first = geometry.centre({0, 0, 0}).cast<float>() - c.centre;
  for (int i = 0; i < geometry.size().x(); ++i) {
    for (int j = 0; j < geometry.size().y(); ++j) {
      for (int k = 0; k < geometry.size().z(); ++k) {
        VoxelState& label = labels[index(geometry, {i, j, k})];
        if (label == VoxelState::occupied) continue;
        const Eigen::Vector3f p =
            c.rotation * (first + voxel_size * Eigen::Vector3f(float(i), float(j), float(k)));
        if (!c.in_range(p.z())) continue;
        const int u = int(std::floor(c.fx * p.x() / p.z() + c.cx + 0.5f));
        const int v = int(std::floor(c.fy * p.y() / p.z() + c.cy + 0.5f));
        if (u < 0 || u >= depth.width() || v < 0 || v >= depth.height()) continue;
        const float d = depth.at(u, v);
        if (!c.in_range(d)) continue;
        const float half_band = 0.5f * std::max(voxel_size, sigmas * d * d);
        if (std::abs(p.z() - d) <= half_band) {
          label = VoxelState::occupied;
        } else if (p.z() < d) {
          label = VoxelState::free;
        }
      }
    }
  }
  return labels;
}

}  // namespace vantage::bench
