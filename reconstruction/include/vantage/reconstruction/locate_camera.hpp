#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vantage/raycore/export.hpp"
#include "vantage/reconstruction/observation.hpp"

namespace vantage {

/// Limits of located features' residuals.
struct LocateOptions {
  double inlier_px = 3.0;  ///< a marker with a corner farther off counts as wrong
  /// Two poses that explain the corners nearly equally well are told apart only if the worse one's
  /// chi-square is above the better one's by this; 13.8 is a chance of 1 : 1000 for a wrong choice.
  double min_evidence = 13.8;
};

/// A pose of a camera that the markers of the board support.
struct LocatedPose {
  Pose T_world_cam;
  Matrix6d covariance = Matrix6d::Zero();  ///< of T_world_cam
  double rms_px = 0;                       ///< of the corners of the inliers, per coordinate pair
  double chi_square = 0;
};

/// Where a camera is.
struct CameraLocation {
  std::optional<LocatedPose> pose = {};  ///< none: `reason` says why
  std::string reason = {};               ///< empty if there is a pose
  /// The other pose of a board that may just as well be tilted the other way (the flip of planar
  /// targets); then there is no `pose`, and both are here, the likelier one first.
  std::vector<LocatedPose> alternatives = {};
  std::vector<std::size_t> inliers = {};   ///< observations that the pose explains
  std::vector<std::size_t> outliers = {};  ///< observations of the board's markers that it does not
  /// Of the board's markers, those that are seen and sound, each counted once: the pose is "by 5 of
  /// 7 markers".
  std::size_t markers_seen = 0;
  /// What contradicts the pose, with the likely cause; empty if nothing does. The covariance is
  /// then wide enough for the cause that is named.
  std::string warning = {};
};

/// The pose of a camera from the markers of a board, whatever their layout; robust against markers
/// that are misread or moved. Minimises the reprojection error with the lens' distortion (robustly)
/// from every pose that a single marker suggests.
///
/// Without a pose, and with a reason, if no marker of the board is seen, if those that agree are
/// less than twice as many as those that contradict them, or if the pose is ambiguous: a planar
/// board far away, seen from the front, or a single marker. Where markers contradict each other, or
/// residuals are larger than noise, the usual mistakes are tried (focal length, resolution, axes, a
/// turned picture, the parity of a checkerboard, sizes, a bent board), and the one that fits is
/// named.
/// @param board features in the world's frame; those without points are ignored.
/// Thread-safe.
VANTAGE_API CameraLocation locate_camera(const Lens& lens,
                                         std::span<const Observation> observations,
                                         std::span<const ObjectFeature> board,
                                         const LocateOptions& options = {});

}  // namespace vantage
