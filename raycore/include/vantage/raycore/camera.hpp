#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/points.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// The pinhole model, pixels. Pixel (u, v) has its centre at integer coordinates.
struct Intrinsics {
  int width = 0;
  int height = 0;
  double fx = 0;
  double fy = 0;
  double cx = 0;
  double cy = 0;

  /// @throws Error bad_input unless 1 <= width, height <= 16384, fx, fy > 0 and all is finite.
  VANTAGE_API void check(std::string_view where) const;
  bool operator==(const Intrinsics&) const = default;
};

/// Depths along the optical axis that a sensor measures, metres.
struct DepthRange {
  double near_m = 0.1;
  double far_m = 3.0;

  /// @throws Error bad_input unless 0 < near_m < far_m and both are finite.
  VANTAGE_API void check(std::string_view where) const;
  bool operator==(const DepthRange&) const = default;
};

/// Where a point falls on the image: pixels, and its depth (z along the optical axis, metres).
struct ImagePoint {
  double u = 0;
  double v = 0;
  double depth = 0;
};

/// A ray through a pixel in the world frame, scaled so that its parameter t is the depth:
/// the point at depth d is `origin + d * direction`. `direction` is not of unit length.
struct PixelRay {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
};

/// A pinhole camera somewhere in the world. Immutable value type; every method is thread-safe.
///
/// Single points are handled in double; batches in float, one array per coordinate, with the same
/// result on every instruction set.
class VANTAGE_API PinholeCamera {
 public:
  /// @throws Error bad_input if the intrinsics or the range are invalid; `where` names the place.
  PinholeCamera(const Intrinsics& intrinsics, const Pose& T_world_cam, const DepthRange& range = {},
                std::string_view where = "camera");

  const Intrinsics& intrinsics() const noexcept { return intrinsics_; }
  const Pose& T_world_cam() const noexcept { return T_world_cam_; }
  const DepthRange& range() const noexcept { return range_; }
  const Eigen::Vector3d& centre() const noexcept { return T_world_cam_.translation(); }
  PinholeCamera moved_to(const Pose& T_world_cam) const;

  /// @returns nothing for a point that is not in front of the camera. The point may lie outside
  /// the image.
  std::optional<ImagePoint> project(const Eigen::Vector3d& p_world) const;
  Eigen::Vector3d unproject(double u, double v, double depth) const;
  PixelRay pixel_ray(double u, double v) const;

  /// Pixels and depths of N points. Where the depth is not positive, u and v are undefined.
  /// @throws Error bad_input unless all spans have `p_world.size` elements.
  void project(PointsView p_world, std::span<float> u, std::span<float> v,
               std::span<float> depth) const;

  /// The points at (u, v, depth), N of each.
  /// @throws Error bad_input unless all spans have the same size.
  Points unproject(std::span<const float> u, std::span<const float> v,
                   std::span<const float> depth) const;

  /// Directions, scaled as in PixelRay, through N pixels; their origin is `centre()`.
  /// @throws Error bad_input unless both spans have the same size.
  Points pixel_directions(std::span<const float> u, std::span<const float> v) const;

  /// Whether a point is inside the image and inside the depth range, occlusion aside.
  bool in_view(const Eigen::Vector3f& p_world) const;

  /// The same, to the bit, for N points: 1 or 0 for each.
  /// @throws Error bad_input unless `result` has `p_world.size` elements.
  void in_view(PointsView p_world, std::span<std::uint8_t> result) const;

  /// The same, to the bit, for some packets of the points: bit l of `masks[i]` for point l of
  /// packet `packets[i]`.
  /// @throws Error bad_input unless both spans are of one size, and every packet is there in full.
  void in_view(PointsView p_world, std::span<const std::uint32_t> packets,
               std::span<std::uint16_t> masks) const;

 private:
  Intrinsics intrinsics_;
  Pose T_world_cam_;
  DepthRange range_;
};

}  // namespace vantage
