#include "workload.hpp"

#include <cmath>
#include <utility>

#include "vantage/raycore/camera.hpp"

namespace vantage::bench {
namespace {

const Eigen::Vector3d kEye(0.7, -0.5, 0.6);

void add(Workload& work, const Eigen::Vector3f& origin, const Eigen::Vector3f& end) {
  work.origins.push_back(origin);
  work.ends.push_back(end);
  work.directions.push_back(end - origin);
}

}  // namespace

const std::vector<TriangleMesh>& five_cubes() {
  static const std::vector<TriangleMesh> scene = [] {
    std::vector<TriangleMesh> cubes;
    for (int i = 0; i < 5; ++i) {
      const Eigen::Vector3d corner(0.07 * i - 0.165, 0.03 * (i % 3) - 0.05, 0);
      cubes.push_back(
          TriangleMesh::from_box(Box(corner, corner + Eigen::Vector3d::Constant(0.05))));
    }
    return cubes;
  }();
  return scene;
}

const std::vector<TriangleMesh>& million_triangles() {
  static const std::vector<TriangleMesh> scene = [] {
    constexpr std::uint32_t kCells = 708;  // 2 · 708² = 1,002,528 triangles
    std::vector<Eigen::Vector3f> vertices;
    std::vector<Triangle> triangles;
    for (std::uint32_t j = 0; j <= kCells; ++j) {
      for (std::uint32_t i = 0; i <= kCells; ++i) {
        const float x = float(i) / kCells - 0.5f, y = float(j) / kCells - 0.5f;
        const float waves = std::sin(23 * x) * std::cos(19 * y) + 0.2f * std::sin(151 * (x + y));
        vertices.emplace_back(x, y, 0.06f + 0.04f * waves);
        if (i == kCells || j == kCells) continue;
        const std::uint32_t a = j * (kCells + 1) + i, b = a + kCells + 1;
        triangles.push_back({a, a + 1, b + 1});
        triangles.push_back({a, b + 1, b});
      }
    }
    return std::vector<TriangleMesh>{TriangleMesh(std::move(vertices), std::move(triangles))};
  }();
  return scene;
}

Workload voxels_to_camera(std::string name, const std::vector<TriangleMesh>& scene) {
  Workload work{std::move(name), &scene, {}, {}, {}, true, false, false};
  constexpr int kSide = 64;
  constexpr float kVoxel = 0.4f / kSide;
  for (int k = 0; k < kSide / 2; ++k) {
    for (int j = 0; j < kSide; ++j) {
      for (int i = 0; i < kSide; ++i) {
        const Eigen::Vector3f centre((float(i) + 0.5f) * kVoxel - 0.2f,
                                     (float(j) + 0.5f) * kVoxel - 0.2f, (float(k) + 0.5f) * kVoxel);
        add(work, centre, kEye.cast<float>());
      }
    }
  }
  return work;
}

Workload in_cache(const Workload& work) {
  Workload few{work.name + " in cache", work.scene,   {}, {}, {}, work.one_end,
               work.one_origin,         work.coherent};
  const std::size_t step = work.size() / 8192 * 16;
  for (std::size_t first = 0; few.size() < 8192; first += step) {
    for (std::size_t i = first; i < first + 16; ++i) add(few, work.origins[i], work.ends[i]);
  }
  return few;
}

Workload pixels(std::string name, const std::vector<TriangleMesh>& scene) {
  Workload work{std::move(name), &scene, {}, {}, {}, false, true, true};
  const PinholeCamera camera({640, 480, 800, 800, 319.5, 239.5},
                             Pose::looking_at(kEye, {0, 0, 0.02}));
  for (int v = 0; v < 480; ++v) {
    for (int u = 0; u < 640; ++u) {
      add(work, kEye.cast<float>(), camera.unproject(u, v, 2.0).cast<float>());
    }
  }
  return work;
}

}  // namespace vantage::bench
