#include "shadow_rectangles.hpp"

#include <algorithm>

#include <Eigen/Geometry>

namespace vantage::detail {

ShadowRectangles::ShadowRectangles(const TriangleMesh& faces) {
  corners.reserve(faces.vertices().size());
  for (const Eigen::Vector3f& corner : faces.vertices()) {
    corners.push_back(corner.cast<double>());
    largest_coordinate_m = std::max(largest_coordinate_m, corners.back().cwiseAbs().maxCoeff());
  }
  for (std::size_t i = 0; i + 1 < faces.triangles().size(); i += 2) {
    const Triangle &abc = faces.triangles()[i], &acd = faces.triangles()[i + 1];
    const Eigen::Vector3d& a = corners[abc[0]];
    const Eigen::Vector3d normal = (corners[abc[1]] - a).cross(corners[abc[2]] - a);
    int axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    list.push_back(
        {{abc[0], abc[1], abc[2], acd[2]}, axis, normal[axis] > 0 ? 1.0 : -1.0, a[axis]});
  }
}

}  // namespace vantage::detail
