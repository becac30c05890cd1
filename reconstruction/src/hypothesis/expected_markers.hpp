#pragma once

#include "pose/extrapolated_lens.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/reconstruction/observation.hpp"

namespace vantage::reconstruction::detail {

/// Probability that a marker is missed for reasons that no table of the detector knows: light,
/// blur, dirt, a reflection.
inline constexpr double kMarkerMissed = 0.2;

/// Probability that something unknown hides a whole object from a view.
inline constexpr double kViewHidden = 0.15;

/// Which markers a view should see. Refers to the view and the scene; thread-safe.
class ExpectedMarkers {
 public:
  /// @param view with T_world_cam.
  /// @param scene what hides markers.
  ExpectedMarkers(const CameraView& view, const Scene& scene);

  /// How likely the detector finds this marker of an object at this pose: by its size and angle
  /// (`detector_recall`), with the white around it inside the image, and nothing in the way of any
  /// part of it: rays decide. 0 if it cannot be seen.
  double found_probability(const Marker& marker, const Pose& T_world_object) const;

  /// Whether the detector finds it for all but sure (it misses it with `kMarkerMissed`): turned to
  /// the camera, large, in the image, and with nothing in the way.
  bool sees(const Marker& marker, const Pose& T_world_object) const;

 private:
  struct Look {
    double side_px = 0;  ///< as a camera that faced it from there would see it
    double cosine = 0;   ///< between its normal and the line of sight
  };
  Look look_at(const Marker& marker, const Pose& T_world_marker) const;
  bool is_inside(const Marker& marker, const Pose& T_world_object) const;
  bool is_hidden(const Marker& marker, const Pose& T_world_marker) const;

  const CameraView& view_;
  WideLens lens_;
  const Scene& scene_;
  Pose T_cam_world_;
};

}  // namespace vantage::reconstruction::detail
