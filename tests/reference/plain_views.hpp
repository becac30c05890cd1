#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/points.hpp"

namespace vantage::test {

/// Which points a view sees, the obvious way: point by point, each with its own test against the
/// image and the depth range and, if it passes, its own ray. 1 or 0 for each.
std::vector<std::uint8_t> plain_visible(PointsView points, const Scene& occluders,
                                        const PinholeCamera& view);

/// How many points each of the views sees.
std::vector<std::uint64_t> plain_scores(PointsView points, const Scene& occluders,
                                        std::span<const PinholeCamera> views);

/// The thesis' way (7.2.3): a point in view is seen if the segment to the camera meets none of a
/// list of voxels, tried one after the other, in double.
class PlainList {
 public:
  /// @param voxels a work area's occupied voxels: their centres.
  PlainList(PointsView voxels, double voxel_size_m);

  std::uint64_t score(PointsView points, const PinholeCamera& view) const;

 private:
  bool seen(const Eigen::Vector3d& point, const Eigen::Vector3d& eye) const;

  std::vector<Eigen::Vector3d> centres_;
  double half_m_;
};

}  // namespace vantage::test
