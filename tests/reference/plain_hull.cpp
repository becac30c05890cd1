#include "reference/plain_hull.hpp"

#include <Eigen/Geometry>
#include <cstdint>

namespace vantage::test {

TriangleMesh plain_hull(const std::vector<Eigen::Vector3f>& points) {
  const std::uint32_t count = std::uint32_t(points.size());
  const auto point = [&](std::uint32_t i) { return points[i].cast<double>(); };
  std::vector<Triangle> faces;
  for (std::uint32_t i = 0; i < count; ++i) {
    for (std::uint32_t j = i + 1; j < count; ++j) {
      for (std::uint32_t k = j + 1; k < count; ++k) {
        const Eigen::Vector3d normal =
            Eigen::Vector3d(point(j) - point(i)).cross(Eigen::Vector3d(point(k) - point(i)));
        std::uint32_t above = 0, below = 0;
        for (std::uint32_t other = 0; other < count; ++other) {
          if (other == i || other == j || other == k) continue;
          ++(normal.dot(point(other) - point(i)) > 0 ? above : below);
        }
        if (above == 0) faces.push_back({i, j, k});
        if (below == 0) faces.push_back({i, k, j});
      }
    }
  }
  return {points, std::move(faces)};
}

}  // namespace vantage::test
