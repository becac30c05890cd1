#pragma once

#include <optional>
#include <span>
#include <vector>

#include "support/support_body.hpp"

namespace vantage::reconstruction::detail {

/// Where two bodies may touch.
struct ContactPoint {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;  ///< in which `upper` is pushed; unit length
  double gap_m = 0;        ///< along the normal; negative where they overlap
  /// Whether a face of the upper body lies on a face of the lower one, as far as the poses say.
  bool is_flat = false;
  Eigen::Vector3d upper_normal = Eigen::Vector3d::Zero();  ///< of that face of the upper body
};

/// All contact of two bodies: corners of polygons in which they touch.
struct ContactPatch {
  std::size_t upper = 0, lower = 0;  ///< bodies; the floor is `bodies.size()`
  std::vector<ContactPoint> points;
  double slack_m = 0;  ///< sideways, how far the upper body may be off the lower one
};

/// What touches what. `upper` is the body whose middle is higher, and never fixed.
/// @param bodies those that are not fixed come first.
std::vector<ContactPatch> find_contacts(std::span<const SupportBody> bodies,
                                        const SupportOptions& options);

/// Bodies, and what of them touches.
struct ContactScene {
  std::vector<SupportBody> bodies;  ///< objects first, then structures
  std::vector<ContactPatch> patches;
};

ContactScene contact_scene(std::span<const ReconstructedObject> objects,
                           std::span<const KnownObject> structures, const SupportOptions& options);

/// How far apart two bodies may be at a point, along a direction, and touch all the same.
/// @param lower null: the floor.
double contact_slack(const SupportBody& upper, const SupportBody* lower,
                     const Eigen::Vector3d& point, const Eigen::Vector3d& direction,
                     const SupportOptions& options);

/// The points that are farthest in each of 16 directions across the normal, each once: corners of
/// their convex hull. All of them have about the same normal.
std::vector<ContactPoint> outermost(std::span<const ContactPoint> points);

}  // namespace vantage::reconstruction::detail
