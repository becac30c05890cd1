#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vantage/raycore/box.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage::volume::detail {

/// Part of a pixel's ray, by depth along the optical axis, metres.
struct DepthSpan {
  double enter_m, exit_m;
};

/// A pixel with a reading.
struct DepthSample {
  int u, v;
  double depth_m;
  std::optional<DepthSpan> area;  ///< where its ray crosses the work area
};

/// The centres of nine cells along each axis.
std::vector<Eigen::Vector3d> area_samples(const Box& work_area);

/// The share of the points that lie before the camera and in its image, occlusion and depth range
/// aside.
double coverage_of(const PinholeCamera& camera, const std::vector<Eigen::Vector3d>& points);

/// Every pixel of a coarse lattice that has a reading, whatever the range says of it.
std::vector<DepthSample> depth_samples(const DepthCamera& camera, const Box& work_area);

/// The box with a margin of a share of its diagonal on every side.
Box grown(const Box& box, double share);

}  // namespace vantage::volume::detail
