#pragma once

#include <Eigen/Core>
#include <memory>

#include "flat_faces.hpp"
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
  double nearest_m;     ///< no ray meets it nearer than this, unless it is grazing
  double farthest_m;    ///< nor farther than this
  bool grazing;         ///< seen from so flat that nothing is known of its rays' depths
};

/// Projects faces into one camera; all their corners at once, before the first is asked for.
class FaceProjector {
 public:
  /// Where polygons are wanted.
  struct Window {
    PixelSpan columns, rows;
    double farthest_m;
  };

  /// @param faces have to outlive this.
  FaceProjector(const PinholeCamera& camera, const FlatFaces& faces);
  FaceProjector(const PinholeCamera& camera, const FlatFaces& faces, const Window& window);

  /// How far rounding may move a ray, metres.
  double margin_m() const { return margin_m_; }
  /// The largest depth of any corner.
  double farthest_m() const { return farthest_m_; }
  /// How far the camera is in front of a face's plane.
  double height_m(const FlatFaces::Face& face) const {
    return face.normal.dot(centre_) - face.offset_m;
  }

  /// @returns false if no ray of the window can meet the face within the depth range.
  bool project(const FlatFaces::Face& face, FacePolygon& polygon) const;

  /// The same, but for depths and what is certain; small polygons are left at their columns and
  /// rows.
  bool project_outline(const FlatFaces::Face& face, FacePolygon& polygon) const;

 private:
  /// A face's corners, cut off at the near depth.
  struct Corners {
    static constexpr int kMost = 8;
    int count;
    double u[kMost], v[kMost];
    double top, bottom;
    double nearest_m, farthest_m;
    double margin;  ///< pixels by which rounding may move a ray
  };

  bool project_corners(const FlatFaces::Face& face, Corners& corners, FacePolygon& polygon) const;
  void clip(const FlatFaces::Face& face, Corners& corners) const;
  void set_edges(const Corners& corners, FacePolygon& polygon) const;
  void set_depth(const FlatFaces::Face& face, const Corners& corners, FacePolygon& polygon) const;

  const FlatFaces& faces_;
  Intrinsics image_;
  Window window_;
  Eigen::Vector3d centre_;
  Eigen::Matrix3d R_cam_world_;
  double margin_m_;
  double pixels_per_radian_;  ///< at most, anywhere on the image
  double clip_m_;             ///< what is nearer does not count
  double farthest_m_ = 0;

  // Of every corner. Pixels are of no use where the depth is not above `clip_m_`.
  std::unique_ptr<double[]> u_, v_, depth_;
};

}  // namespace vantage::detail
