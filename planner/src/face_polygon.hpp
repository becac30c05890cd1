#pragma once

#include <Eigen/Core>
#include <span>

#include "vantage/raycore/camera.hpp"

namespace vantage::detail {

/// An edge of a convex polygon on an image, as the column where it crosses row v:
/// u = slope · v + offset. Outside `outer` no ray meets the polygon, inside `inner` every ray does.
struct PolygonEdge {
  float slope, outer, inner;
};

/// Rows or columns first … last; none if last < first.
struct PixelSpan {
  int first, last;
};

/// A flat face as it falls on an image: the pixels whose rays may meet it, those whose rays
/// certainly do, and at which depth at most. Certified: rounding is allowed for.
struct FacePolygon {
  static constexpr int kMostEdges = 5;

  PixelSpan columns, rows;  ///< beyond them, no ray meets it
  PixelSpan certain_rows;   ///< beyond them, no ray is certain to
  int left_edges = 0, right_edges = 0;
  PolygonEdge left[kMostEdges], right[kMostEdges];

  /// 1 / depth is at least at_origin + per_u · u + per_v · v (pixels), for certain pixels.
  float at_origin, per_u, per_v;
  float least_inverse;  ///< of all depths that count
  double nearest_m;     ///< no point of it is nearer
  bool grazing;         ///< seen from so flat that nothing is known of its rays' depths
};

/// Projects faces into one camera.
class FaceProjector {
 public:
  /// @param largest_coordinate_m of the faces.
  FaceProjector(const PinholeCamera& camera, double largest_coordinate_m);

  Eigen::Vector3d to_camera(const Eigen::Vector3d& p_world) const {
    return R_cam_world_ * (p_world - centre_);
  }
  /// How far rounding may move a ray, metres.
  double margin_m() const { return margin_m_; }

  /// @param corners of a rectangle, camera frame.
  /// @param normal of it, camera frame, of length 1.
  /// @param distance_m of the camera from its plane, never negative.
  /// @returns false if no ray can meet it within the depth range.
  bool project(const Eigen::Vector3d (&corners)[4], const Eigen::Vector3d& normal,
               double distance_m, FacePolygon& polygon) const;

 private:
  struct ImageCorner {
    double u, v;
  };
  void set_edges(std::span<const ImageCorner> corners, double margin, FacePolygon& polygon) const;
  void set_depth(const Eigen::Vector3d& normal, double distance_m, double farthest_m,
                 FacePolygon& polygon) const;

  Intrinsics image_;
  DepthRange range_;
  Eigen::Vector3d centre_;
  Eigen::Matrix3d R_cam_world_;
  double margin_m_;
  double pixels_per_radian_;  ///< at most, anywhere on the image
};

}  // namespace vantage::detail
