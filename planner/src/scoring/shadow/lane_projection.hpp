#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "scoring/voxel/box_soa.hpp"
#include "vantage/raycore/camera.hpp"

// Many points or boxes at a time into one camera, in loops that are vectorised.

namespace vantage::planner::detail {

/// A camera as plain numbers.
struct Projection {
  double r[9], eye[3];  ///< world to camera
  double fx, fy, cx, cy;

  explicit Projection(const PinholeCamera& camera);
};

/// One array per coordinate.
struct PointArrays {
  const double *x, *y, *z;
};

/// Pixels are undefined where the depth is not positive.
void project_points(const Projection& p, const PointArrays& points, std::size_t count, double* u,
                    double* v, double* depth);

/// Where eight boxes' corners are on the image at most. Pixels are undefined where `nearest` is not
/// positive.
struct BoxImages {
  double left[kBoxLanes], right[kBoxLanes], top[kBoxLanes], bottom[kBoxLanes];
  double nearest[kBoxLanes], farthest[kBoxLanes];
};

/// Eight boxes from `first` on.
void project_boxes(const Projection& p, const BoxLanes& boxes, std::size_t first,
                   BoxImages& images);

}  // namespace vantage::planner::detail
