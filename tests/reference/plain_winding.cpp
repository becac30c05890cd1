#include "reference/plain_winding.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace vantage::test {

double plain_winding(std::span<const Eigen::Vector3f> vertices, std::span<const Triangle> triangles,
                     const Eigen::Vector3d& point) {
  double sum = 0;
  for (const Triangle& triangle : triangles) {
    // l'Huilier: the solid angle as the area of a spherical triangle, from its sides.
    const Eigen::Vector3d a = (vertices[triangle[0]].cast<double>() - point).normalized();
    const Eigen::Vector3d b = (vertices[triangle[1]].cast<double>() - point).normalized();
    const Eigen::Vector3d c = (vertices[triangle[2]].cast<double>() - point).normalized();
    const auto side = [](const Eigen::Vector3d& u, const Eigen::Vector3d& v) {
      return std::atan2(u.cross(v).norm(), u.dot(v));
    };
    const double bc = side(b, c), ca = side(c, a), ab = side(a, b), s = (bc + ca + ab) / 2;
    const double product =
        std::tan(s / 2) * std::tan((s - bc) / 2) * std::tan((s - ca) / 2) * std::tan((s - ab) / 2);
    const double area = 4 * std::atan(std::sqrt(std::max(product, 0.0)));
    sum += a.dot(b.cross(c)) < 0 ? -area : area;
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace vantage::test
