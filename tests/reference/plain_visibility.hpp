#pragma once

#include "reference/moller_trumbore.hpp"
#include "vantage/raycore/lens.hpp"

// The slow, obvious twin of what cameras should see of a marker: every ray alone, against every
// triangle.
namespace vantage::test {

struct PlainSight {
  bool visible = false;
  bool close_call = false;  ///< it may as well be the other way round
  double side_px = 0;       ///< of the marker's side, seen from the front at its distance
  double angle_rad = 0;     ///< between its normal and the line to the camera
};

/// Visible: turned to the camera, its corners at least `border_px` inside the image, and the way
/// free from the camera to 4 × 4 points over the marker and a fifth more, 2 mm before it.
PlainSight plain_sight(const Lens& lens, const Pose& T_world_cam, const Pose& T_world_marker,
                       double size_m, double border_px, const ReferenceScene& scene);

}  // namespace vantage::test
