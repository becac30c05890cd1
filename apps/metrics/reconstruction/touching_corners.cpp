#include "metrics/reconstruction/touching_corners.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace vantage {
namespace {

using Corners = std::vector<Eigen::Vector3d>;

Eigen::AlignedBox3d box_around(const PlacedModel& object, double margin_m) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& vertex : object.model->vertices) {
    box.extend(object.T_world_object * vertex);
  }
  return {(box.min().array() - margin_m).matrix(), (box.max().array() + margin_m).matrix()};
}

/// The vertices that lie in a box, in the object's frame. A mesh has a vertex more than once where
/// its faces have normals or textures of their own.
Corners corners_in(const Eigen::AlignedBox3d& box, const PlacedModel& object, double tolerance_m) {
  Corners corners;
  for (const Eigen::Vector3d& vertex : object.model->vertices) {
    if (!box.contains(object.T_world_object * vertex)) continue;
    const bool known = std::ranges::any_of(corners, [&](const Eigen::Vector3d& corner) {
      return (corner - vertex).norm() <= tolerance_m;
    });
    if (!known) corners.push_back(vertex);
  }
  return corners;
}

}  // namespace

std::vector<TouchingCorners> touching_corners(std::span<const PlacedModel> objects,
                                              double tolerance_m) {
  std::vector<TouchingCorners> pairs;
  for (std::size_t a = 0; a < objects.size(); ++a) {
    const Eigen::AlignedBox3d box_a = box_around(objects[a], tolerance_m);
    for (std::size_t b = a + 1; b < objects.size(); ++b) {
      const Corners of_a = corners_in(box_around(objects[b], tolerance_m), objects[a], tolerance_m);
      const Corners of_b = corners_in(box_a, objects[b], tolerance_m);
      for (const Eigen::Vector3d& corner_a : of_a) {
        const Eigen::Vector3d in_world = objects[a].T_world_object * corner_a;
        for (const Eigen::Vector3d& corner_b : of_b) {
          if ((objects[b].T_world_object * corner_b - in_world).norm() > tolerance_m) continue;
          pairs.push_back({a, b, corner_a, corner_b});
        }
      }
    }
  }
  return pairs;
}

double self_consistency_mm2(std::span<const TouchingCorners> pairs,
                            std::span<const Pose> T_world_object) {
  double sum_m2 = 0;
  for (const TouchingCorners& pair : pairs) {
    sum_m2 += (T_world_object[pair.object_a] * pair.corner_a -
               T_world_object[pair.object_b] * pair.corner_b)
                  .squaredNorm();
  }
  return sum_m2 * 1e6;
}

}  // namespace vantage
