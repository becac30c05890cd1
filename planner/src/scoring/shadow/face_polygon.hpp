#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "scoring/shadow/lane_projection.hpp"
#include "scoring/shadow/planar_faces.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage::planner::detail {

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
  static constexpr int kMaxEdges = 5;

  PixelSpan columns, rows;  ///< beyond them, no ray meets it
  PixelSpan certain_rows;   ///< beyond them, no ray is certain to
  int left_edges = 0, right_edges = 0;
  PolygonEdge left[kMaxEdges], right[kMaxEdges];

  /// 1 / depth is at least at_origin + per_u · u + per_v · v (pixels), for certain pixels.
  float at_origin, per_u, per_v;
  float min_inverse;     ///< of all depths that count
  double nearest_m;      ///< no ray meets it nearer than this, unless it is grazing
  double farthest_m;     ///< nor farther than this
  bool grazing;          ///< seen from so flat that nothing is known of its rays' depths
  std::uint32_t origin;  ///< the polygon's maker may note here what it is of
};

/// Projects faces into one camera, group by group.
class FaceProjector {
 public:
  /// Where polygons are wanted.
  struct Window {
    PixelSpan columns, rows;
    double farthest_m;
  };

  static Window whole_image(const PinholeCamera& camera);

  /// A group of faces, some of which may look at the camera, that the window's rays may meet.
  struct GroupInView {
    std::uint32_t index;
    PixelSpan columns, rows;  ///< beyond them, no ray meets one of its faces
  };

  /// @param faces have to outlive this.
  /// @param from_inside faces are seen from behind, too: the camera is in what they surround.
  FaceProjector(const PinholeCamera& camera, const FlatFaces& faces, const Window& window,
                bool from_inside = false);

  /// How far rounding may move a ray, metres.
  double margin_m() const { return margin_m_; }
  static double margin_m(const PinholeCamera& camera, const FlatFaces& faces);

  /// In the order of the faces.
  const std::vector<GroupInView>& groups() const { return groups_; }

  /// No ray meets a face farther than this, in the window or beyond, from whatever side, unless it
  /// is grazing.
  double farthest_m() const;

  /// Whether a face of the groups may be seen from so flat that nothing is known of its depths.
  bool may_be_grazing() const;

  /// Calls `visit(face)` for those faces of a group that may look at the camera: all that `project`
  /// and `project_outline` may be asked for until this is called again.
  template <class Visit>
  void for_each_face(const GroupInView& seen, const Visit& visit) {
    const FlatFaces::Group& group = faces_.groups[seen.index];
    load_corners(group);
    for (std::uint32_t i = group.first_face; i < group.last_face; ++i) {
      const FlatFaces::Face& face = faces_.list[i];
      if (height_m(face) < lowest_m_) continue;
      if (!group.parallel) outwards_ = R_cam_world_ * face.normal;
      visit(face);
    }
  }

  /// @returns false if no ray of the window can meet the face within the depth range.
  bool project(const FlatFaces::Face& face, FacePolygon& polygon) const;

  /// The same, but for depths and what is certain; small polygons are left at their columns and
  /// rows. Nor is there a polygon of those columns and rows that are not `wanted(polygon)`.
  template <class Wanted>
  bool project_outline(const FlatFaces::Face& face, const Wanted& wanted,
                       FacePolygon& polygon) const {
    Corners corners;
    if (!project_corners(face, corners, polygon) || !wanted(polygon)) return false;
    set_outline(corners, polygon);
    return true;
  }

 private:
  /// A face's corners, cut off at the near depth.
  struct Corners {
    static constexpr int kMax = 8;
    int count;
    double u[kMax], v[kMax];
    double top, bottom;
    double nearest_m, farthest_m;
    double margin;  ///< pixels by which rounding may move a ray
  };

  void find_groups();
  bool in_depth(double nearest_m) const {
    return nearest_m <= window_.farthest_m * (1 + 1e-3) + margin_m_;
  }
  /// Pixels by which rounding may move rays to what is not nearer than this.
  double margin_px(double nearest_m) const;
  double along_m(const FlatFaces::Group& group) const;
  double worst_rounding(const FlatFaces::Group& group) const;
  void load_corners(const FlatFaces::Group& group);
  double height_m(const FlatFaces::Face& face) const {
    return face.normal.dot(centre_) - face.offset_m;
  }
  bool project_corners(const FlatFaces::Face& face, Corners& corners, FacePolygon& polygon) const;
  void clip(const FlatFaces::Face& face, Corners& corners) const;
  void set_edges(const Corners& corners, FacePolygon& polygon) const;
  void set_outline(const Corners& corners, FacePolygon& polygon) const;
  void set_depth(const FlatFaces::Face& face, const Corners& corners, FacePolygon& polygon) const;

  const FlatFaces& faces_;
  Intrinsics image_;
  Window window_;
  Projection projection_;
  Eigen::Vector3d centre_;
  Eigen::Matrix3d R_cam_world_;
  double per_fx_, per_fy_;
  double margin_m_;
  double pixels_per_radian_;  ///< at most, anywhere on the image
  double clip_m_;             ///< what is nearer does not count
  double lowest_m_;           ///< faces that are lower look away
  std::vector<GroupInView> groups_;

  // Of the corners of one group, from `loaded_` on. Pixels are undefined where the depth is not
  // above `clip_m_`.
  std::uint32_t loaded_ = 0;
  Eigen::Vector3d outwards_;  ///< the normal, in the camera's frame, of the face that is visited
  std::array<double, FlatFaces::kMaxCorners> u_, v_, depth_;
};

}  // namespace vantage::planner::detail
