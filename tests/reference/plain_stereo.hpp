#pragma once

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/depth_image.hpp"

namespace vantage::test {

/// What a stereo camera with a projector finds, ray by ray: the exact depth where both imagers (the
/// second one `baseline_m` along the camera's x axis) and the projector see the surface, inside
/// `border_px` of both images, at most `max_incidence_rad` off its normal; unknown elsewhere.
struct PlainStereo {
  double baseline_m, projector_m, max_incidence_rad;
  int border_px;

  DepthImage see(const Scene& scene, const PinholeCamera& camera) const;
};

}  // namespace vantage::test
