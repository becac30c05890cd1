#pragma once

#include <Eigen/Core>

#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"

namespace vantage {

/// Rays and projections in float err by no more than this part of the largest coordinate on their
/// way: some 1e-7 each for the rounding of their ends, of the triangles and of the test.
inline constexpr double kRoundingOfRays = 4e-6;

/// A closed axis-aligned box, metres.
struct Extent {
  Eigen::Vector3d centre, half;
};

enum class Coverage { none, some, all };

/// A rectangle of pixels, [u0, u1] × [v0, v1] in continuous image coordinates.
struct ImageRect {
  double u0, u1, v0, v1;
};

/// A box as a camera has it: how much of it is in view, where it falls on the image, and between
/// which depths. Certified: every point of the box is inside `rect` and the depths, and `none` and
/// `all` hold for every point of the box, float rounding included.
struct BoxInView {
  Coverage coverage = Coverage::some;
  double z_min = 0, z_max = 0;
  ImageRect rect{};  ///< clipped to the image
};

/// Projects boxes into one camera; immutable, thread-safe. Boxes are widened by `margin_m`, so that
/// what is certified also holds for rays and projections in float.
class VANTAGE_API BoxProjector {
 public:
  explicit BoxProjector(const PinholeCamera& camera);

  BoxInView project(const Extent& box, double margin_m) const;

  /// How far float rounding may move a ray from a box to the camera, or the projection of a point.
  double margin_m(const Extent& box) const;

 private:
  PinholeCamera camera_;
  Eigen::Matrix3d R_cam_world_;
};

}  // namespace vantage
