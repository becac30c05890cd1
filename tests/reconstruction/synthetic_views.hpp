#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reconstruction/normal.hpp"
#include "reference/random_scene.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"
#include "vantage/reconstruction/observation.hpp"

// Scenes whose truth is known and whose features are computed, not detected: tests of
// reconstruction need no images.
namespace vantage::test {

/// A rotation vector or an offset with this standard deviation along each axis.
Eigen::Vector3d normal_vector(Random& random, double sigma);

/// The pose that the covariance's (t, r) leads to: (exp(r) R, translation + t).
Pose moved_by(const Pose& pose, const Eigen::Vector3d& t, const Eigen::Vector3d& r);

/// The (t, r) that leads from `from` to `to`, as Matrix6d has it.
Eigen::Matrix<double, 6, 1> difference(const Pose& from, const Pose& to);

/// A box with a marker in the middle of each of its first `faces` sides (+x, -x, +y, -y, +z, -z;
/// 4X4_250, ids from `first_id`), as large as `share` of the side's shorter edge.
ObjectType marked_box(const std::string& name, const Eigen::Vector3d& size_m, int first_id,
                      int faces = 6, double share = 0.7);

struct PlacedObject {
  TypePtr type;
  Pose T_world_object;
};

/// `count` cameras of 640×480 somewhere on the upper half of a sphere, looking at about the origin;
/// every other one with lens distortion.
std::vector<CameraView> cameras_around(Random& random, int count, double radius_m = 0.7);

/// Boxes of random types on a floor of 2 `half_m` along each side, turned at random, that do not
/// touch: their circumscribed spheres stay apart.
std::vector<PlacedObject> scattered(Random& random, const std::vector<TypePtr>& types, int count,
                                    double half_m);

struct ViewNoise {
  double sigma_px = 0.2;  ///< of corners; observations say it too (0.1 for 0)
  double missing = 0;     ///< share of markers that are not seen
  double wrong_id = 0;    ///< share of markers that are read as another one of the types' markers
  double camera_m = 0;    ///< of the views' poses, which then have a covariance
  double camera_rad = 0;
  bool occlusion = true;  ///< objects hide markers
};

/// Which object an observation is of; none for a wrong id.
constexpr int kNobody = -1;

/// What the views see of the objects' markers: those that face the camera by at least 20°, inside
/// the image, with corners that nothing hides. Adds to the views' observations, in the order of
/// objects and features.
/// @returns for each view, the object of each observation that was added.
std::vector<std::vector<int>> look_at(std::vector<CameraView>& views,
                                      const std::vector<PlacedObject>& objects,
                                      const ViewNoise& noise, Random& random);

/// Errors of a pose against the truth, or against what is the same by the type's discrete
/// symmetries, whichever is nearest (translation first, then rotation).
struct PoseError {
  double m = 0;
  double rad = 0;
};
PoseError pose_error(const ObjectType& type, const Pose& found, const Pose& truth);

}  // namespace vantage::test
