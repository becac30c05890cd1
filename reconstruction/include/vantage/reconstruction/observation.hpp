#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/lens.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/reconstruction/object_type.hpp"

namespace vantage {

/// The feature's points on the image, in the order of the object's. Pixels, with the lens'
/// distortion still in them; pixel centres are at integers.
struct SeenPoints {
  std::vector<Eigen::Vector2d> pixels;
  double sigma_px = 0.1;  ///< standard deviation of each coordinate
};

/// The feature's frame as the camera has it.
struct SeenPose {
  Pose T_cam_feature;
  double sigma_m = 0.002;   ///< of each coordinate
  double sigma_rad = 0.02;  ///< around each axis
};

/// A label at a point in space.
struct SeenLabel {
  Eigen::Vector3d p_cam_m;
  double sigma_m = 0.005;
};

/// A feature that a detector saw in one camera's image. Thesis, section 5.1.1.
struct Observation {
  FeatureKey key;
  std::variant<SeenPoints, SeenPose, SeenLabel> data;
};

/// A camera as it looked at the scene, and what was seen in its image.
struct CameraView {
  std::string name;
  Lens lens;                               ///< intrinsics and distortion
  std::optional<Pose> T_world_cam = {};    ///< none: not located; the view is then ignored
  Matrix6d covariance = Matrix6d::Zero();  ///< of T_world_cam; zero where it is taken as exact
  std::vector<Observation> observations = {};
};

/// What is wrong with an observation, e.g. "corner 2 is not finite"; empty for a good one. Points
/// have to be finite and no two the same, standard deviations positive and finite; a marker's
/// corners have to go around a convex quadrangle of more than one pixel.
VANTAGE_API std::string fault_of(const Observation& observation);

}  // namespace vantage
