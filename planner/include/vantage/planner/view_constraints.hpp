#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "vantage/raycore/box.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// Where the robot can move the camera's centre: a spherical shell around its base, world frame.
struct Reach {
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();
  double min_m = 0;
  double max_m = 0;

  /// @throws Error bad_input unless all is finite and 0 <= min_m < max_m.
  VANTAGE_API void check(std::string_view where) const;
};

/// The cells of a grid in space that the robot can move the camera's centre to; none outside it.
struct ReachMap {
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero();  ///< lower corner of cell (0, 0, 0), world
  double cell_m = 0;
  Eigen::Vector3i size = Eigen::Vector3i::Zero();  ///< cells along each axis
  std::vector<std::uint8_t> reachable;             ///< [i, j, k], k fastest; not 0: reachable

  VANTAGE_API bool contains(const Eigen::Vector3d& p_world) const;
  /// @throws Error bad_input unless all is finite, sizes are positive, and `reachable` fits them.
  VANTAGE_API void check(std::string_view where) const;
};

/// Limits the viewing direction: its optical axis is within `half_angle_rad` of `axis`.
struct ViewCone {
  Eigen::Vector3d axis = {0, 0, -1};  ///< world frame; any length but zero
  double half_angle_rad = 0;

  /// @throws Error bad_input unless all is finite, the axis not zero, 0 < half_angle_rad <= π.
  VANTAGE_API void check(std::string_view where) const;
};

/// The camera's housing around its centre.
struct SphereBody {
  double radius_m = 0;
};
/// The same as a box in the camera's frame (x right, y down, z forward).
struct BoxBody {
  Box box;
};
/// None is the camera's centre alone.
using CameraBody = std::variant<std::monostate, SphereBody, BoxBody>;

/// A RealSense D435: its housing of 90 × 25 × 25 mm (Intel, D400 series datasheet). Its front is
/// 4 mm in front of the centre, as depth is measured from 4.2 mm behind the front glass. Across,
/// the centre is taken to be in the middle: where the camera's frame is that of the left imager,
/// which is 17.5 mm beside it, or of the colour imager, and centimetres matter, give the box in
/// that frame.
VANTAGE_API BoxBody d435_body();

/// The caller's own test of whether the camera can be at a pose, e.g. by inverse kinematics or a
/// collision check: nothing if it can, else the reason, e.g. "no joint angles reach it".
///
/// It is called from several threads at once, for the same pose more than once, and in an order
/// that depends on the threads: it must be thread-safe, and its answer must depend on the pose
/// alone. Plans count rejections by their texts: the same cause should have the same words. What it
/// throws comes out of the call that asked it.
using ViewCheck = std::function<std::optional<std::string>(const Pose& T_world_cam)>;

/// A check that gives one reason for all poses for which `feasible` is false.
VANTAGE_API ViewCheck view_check(std::function<bool(const Pose& T_world_cam)> feasible,
                                 std::string reason);

/// Where the camera may be. All limits apply at once. By default the camera has the body of a D435,
/// which stays 20 mm away from everything occupied and out of unseen volume.
struct ViewConstraints {
  std::optional<Reach> reach = {};
  std::optional<Box> reach_box = {};               ///< world frame
  std::shared_ptr<const ReachMap> reach_map = {};  ///< null: none
  std::optional<ViewCone> view_cone = {};
  /// Minimum distance of the body from everything occupied, and from the floor. Shadow is only
  /// possibly occupied: the body must not overlap it, but may touch it.
  double clearance_m = 0.02;
  CameraBody body = d435_body();
  std::optional<double> floor_z_m = 0.0;  ///< height of the floor, world frame; none: no floor
  /// Asked in their order, and only of poses that all of the above allows: candidates, every servo
  /// iteration and every step of polishing, of the first view and of those after it.
  std::vector<ViewCheck> checks = {};

  /// No body and no clearance: a point that is outside of everything, as the thesis has it. The
  /// result is for simulations, or for callers who know where the camera fits.
  VANTAGE_API static ViewConstraints bare();

  /// @throws Error bad_input as its parts do; for a clearance or a radius that is negative or not
  /// finite, for a floor that is not finite, and for an empty check.
  VANTAGE_API void check() const;
};

/// Why a camera cannot be at a pose, in the order in which it is tested.
enum class InvalidReason : std::uint8_t {
  none,
  below_the_floor,  ///< not above floor_z_m
  out_of_reach,
  outside_the_view_cone,
  inside_occupied_volume,
  inside_shadow,
  too_close_to_shadow,  ///< closer to it than the camera's near depth: it would not be measured
  body_in_unseen,       ///< the body would overlap shadow, whatever the cause of that is
  /// The body is closer to it, or to the floor, than the clearance, or touches it.
  too_close_to_occupied,
  rejected_by_check,  ///< by one of `ViewConstraints::checks`, which says why
};
/// In words, e.g. "out of reach".
VANTAGE_API std::string_view to_text(InvalidReason reason);

}  // namespace vantage
