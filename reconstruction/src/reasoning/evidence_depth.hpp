#pragma once

#include <span>
#include <vector>

#include "vantage/raycore/world_model.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

// Private: what depth images say of an object at a pose.
namespace vantage::reconstruction::detail {

/// A depth image at a point's pixel.
struct DepthReading {
  double measured_m = 0, expected_m = 0;  ///< along the optical axis

  /// Whether something else than a surface at the point is measured: nearer, or farther away.
  /// @param slack_m what the point may be off by, beside the noise of depth.
  bool is_before(double slack_m = 0) const;
  bool is_behind(double slack_m = 0) const;
};

/// Nothing outside the image, beyond the camera's range, and where the image has no depth.
std::optional<DepthReading> depth_reading(const DepthCamera& camera,
                                          const Eigen::Vector3d& p_world);

/// For each view the depth cameras that stand beside it and see what it sees. Refers to `depth`.
std::vector<std::vector<const DepthCamera*>> depth_beside(std::span<const CameraView> views,
                                                          std::span<const DepthCamera> depth);

/// A point of an object's surface.
struct SurfacePoint {
  Eigen::Vector3d p_object, normal;
};

/// Points spread over a mesh by area, always the same ones.
std::vector<SurfacePoint> surface_points(const TriangleMesh& mesh);

/// What depth images show where an object would be.
struct DepthAtObject {
  int through = 0;  ///< of its surface's points: what is seen there lies behind
  int at = 0;       ///< a surface is measured there
  int hidden = 0;   ///< something nearer is measured

  /// Whether light came through where the object would be.
  bool refutes() const { return through >= 6 && through * 10 >= (through + at) * 7; }
  /// Whether something is there, of this shape as far as can be seen.
  bool supports() const { return at >= 6 && at * 10 >= (through + at) * 7; }
};

/// @param slack_m what the pose may be off by.
DepthAtObject depth_at(const DepthCamera& camera, std::span<const SurfacePoint> surface,
                       const Pose& T_world_object, double slack_m = 0);

/// The logarithm of the likelihood ratio of what one image shows: an object there, or not.
/// Neighbouring points are wrong together, so that many count no more than a few.
double log_ratio_of(const DepthAtObject& shown);

/// The same of the readings at the features that support the object: a marker of another size seems
/// to be nearer or farther than what is measured at its pixels.
double log_ratio_at_features(const ReconstructedObject& object,
                             std::span<const std::vector<const DepthCamera*>> beside,
                             double slack_m);

}  // namespace vantage::reconstruction::detail
