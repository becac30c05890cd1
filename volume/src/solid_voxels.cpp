#include "solid_voxels.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "vantage/raycore/scene_builder.hpp"

namespace vantage::detail {
namespace {

/// Voxels [first, last) along each axis.
struct VoxelRange {
  Eigen::Vector3i first, last;

  Eigen::Vector3i size() const { return last - first; }
  bool empty() const { return (size().array() <= 0).any(); }
  std::size_t index(const Eigen::Vector3i& voxel) const {
    const Eigen::Vector3i v = voxel - first, n = size();
    return (std::size_t(v.x()) * std::size_t(n.y()) + std::size_t(v.y())) * std::size_t(n.z()) +
           std::size_t(v.z());
  }
};

VoxelRange bounds_in_grid(const TriangleMesh& mesh, const GridGeometry& geometry) {
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max());
  Eigen::Vector3f high = -low;
  for (const Eigen::Vector3f& p : mesh.vertices()) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const auto index = [&](const Eigen::Vector3f& p) -> Eigen::Array3d {
    return ((p.cast<double>() - geometry.origin()) / geometry.voxel_size_m()).array().floor();
  };
  const Eigen::Array3d top = geometry.size().array().cast<double>();
  return {index(low).max(0.0).min(top).cast<int>().matrix(),
          (index(high) + 1).max(0.0).min(top).cast<int>().matrix()};
}

/// Votes for the voxels of one row that lie inside, by walking from surface to surface.
template <class Vote>
void walk_row(const Scene& scene, const GridGeometry& geometry, const VoxelRange& range,
              Eigen::Vector3i voxel, int axis, float start, const Vote& vote) {
  voxel[axis] = range.first[axis];
  Ray ray;
  ray.origin = geometry.centre(voxel).cast<float>();
  ray.origin[axis] = start;  // outside the object's bounds
  ray.direction = Eigen::Vector3f::Unit(axis);
  int winding = 0;
  while (voxel[axis] < range.last[axis]) {
    const std::optional<Hit> hit = scene.closest_hit(ray);
    const float t = hit ? hit->t : std::numeric_limits<float>::infinity();
    for (; voxel[axis] < range.last[axis]; ++voxel[axis]) {
      if (float(geometry.centre(voxel)[axis]) - start >= t) break;
      if (winding != 0) vote(voxel);
    }
    if (!hit) return;
    winding += hit->normal[axis] < 0 ? 1 : -1;
    ray.t_near = std::nextafter(t, std::numeric_limits<float>::infinity());
  }
}

}  // namespace

void add_solid_voxels(const KnownObject& object, const GridGeometry& geometry, VoxelMask& solid) {
  const TriangleMesh mesh = object.mesh->transformed(object.T_world_object);
  const VoxelRange range = bounds_in_grid(mesh, geometry);
  if (mesh.empty() || range.empty()) return;
  SceneBuilder builder;
  builder.add_mesh(mesh);
  const std::shared_ptr<const Scene> scene = builder.build();

  float low[3], margin = float(geometry.voxel_size_m());
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = std::numeric_limits<float>::max();
    for (const Eigen::Vector3f& p : mesh.vertices()) low[axis] = std::min(low[axis], p[axis]);
  }
  const Eigen::Vector3i n = range.size();
  std::vector<std::uint8_t> votes(std::size_t(n.x()) * std::size_t(n.y()) * std::size_t(n.z()));
  for (int axis = 0; axis < 3; ++axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    tbb::parallel_for(range.first[a], range.last[a], [&](int row) {
      for (int column = range.first[b]; column < range.last[b]; ++column) {
        Eigen::Vector3i voxel = range.first;
        voxel[a] = row, voxel[b] = column;
        walk_row(*scene, geometry, range, voxel, axis, low[axis] - margin,
                 [&](const Eigen::Vector3i& inside) { ++votes[range.index(inside)]; });
      }
    });
  }
  for (int i = range.first.x(); i < range.last.x(); ++i)
    for (int j = range.first.y(); j < range.last.y(); ++j)
      for (int k = range.first.z(); k < range.last.z(); ++k)
        if (votes[range.index({i, j, k})] >= 2) solid.set({i, j, k});
}

}  // namespace vantage::detail
