#pragma once

#include "pose/extrapolated_lens.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/reconstruction/observation.hpp"

namespace vantage::reconstruction::detail {

/// Probability that a detector misses a marker that `ExpectedMarkers` expects it to find.
inline constexpr double kMarkerMissed = 0.2;

/// Probability that something unknown hides a whole object from a view.
inline constexpr double kViewHidden = 0.15;

/// Which markers a view should see. Refers to the view and the scene; thread-safe.
class ExpectedMarkers {
 public:
  /// @param view with T_world_cam.
  /// @param scene what hides markers.
  ExpectedMarkers(const CameraView& view, const Scene& scene);

  /// Whether the detector should find this marker of an object at this pose: turned to the camera,
  /// inside the image with the white around it, large enough, and with nothing between.
  bool sees(const Marker& marker, const Pose& T_world_object) const;

 private:
  bool is_inside(const Eigen::Vector2d& pixel) const;

  const CameraView& view_;
  WideLens lens_;
  const Scene& scene_;
  Pose T_cam_world_;
};

}  // namespace vantage::reconstruction::detail
