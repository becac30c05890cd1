#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "vantage/raycore/lens.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage::reconstruction::detail {

/// Poses T_cam_body in which a camera may see known points at these pixels; the best first, none
/// for points that are too few, collinear or not finite. Coplanar points (a marker's corners) have
/// up to two: seen from the front, a tilt one way looks nearly like the same tilt the other way.
/// Three points have up to four (P3P).
struct PoseGuess {
  Pose T_cam_body;
  double rms_px = 0;
};
std::vector<PoseGuess> solve_pnp(const Lens& lens, std::span<const Eigen::Vector3d> points_m,
                                 std::span<const Eigen::Vector2d> pixels);

}  // namespace vantage::reconstruction::detail
