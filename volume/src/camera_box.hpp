#pragma once

#include <Eigen/Core>

#include "vantage/raycore/camera.hpp"

namespace vantage::detail {

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

/// Projects boxes into one camera. Boxes are widened by `margin_m`, so that what is certified also
/// holds for rays and projections in float.
class BoxProjector {
 public:
  explicit BoxProjector(const PinholeCamera& camera);

  BoxInView project(const Extent& box, double margin_m) const;

  /// How far float rounding may move a ray or a projection near a box: rays err by some 1e-7 of the
  /// largest coordinate on their way.
  double margin_m(const Extent& box) const;

 private:
  PinholeCamera camera_;
  Eigen::Matrix3d R_cam_world_;
};

}  // namespace vantage::detail
