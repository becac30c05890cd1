#pragma once

#include <cstdint>
#include <vector>

#include "scoring/shadow/face_polygon.hpp"
#include "scoring/shadow/planar_faces.hpp"
#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage::planner::detail {

/// What is known before any view: the shadow's faces, and those of what may hide it.
struct ShadowFaces {
  FlatFaces shadow, occluders;

  explicit ShadowFaces(const PlanningScene& scene);

  /// How far a group of the shadow's faces is behind the plane of an occluder, as one looks at it
  /// from outside; negative if a part of it is in front. Metres.
  float behind_m(std::uint32_t occluder, std::uint32_t group) const {
    return behind_m_[occluder * shadow.groups.size() + group];
  }

 private:
  std::vector<float> behind_m_;
};

/// Rays are too uncertain for anything to be drawn: faces may be anywhere on the image.
bool too_uncertain(const FaceProjector& projector, const PinholeCamera& view);

/// Stands for every face then.
FacePolygon whole_image(const PinholeCamera& view);

/// Makes `all` hold `one`, too.
void widen(PixelSpan& all, const PixelSpan& one);

/// @param grid that the faces were made from.
FaceProjector project_shadow(const PinholeCamera& view, const ShadowFaces& all,
                             const StateGrid& grid);

/// The faces of the shadow that a view's rays may meet first, as far as they are on the image and
/// in the depth range: from outside, those that look at the camera. And among them what hides some
/// of them.
struct ShadowInView {
  std::vector<FacePolygon> polygons;      ///< the shadow's first, then occluders
  std::size_t shadow_count = 0;           ///< number of the shadow's polygons
  PixelSpan columns{0, -1}, rows{0, -1};  ///< all polygons lie in there
  double farthest_m = 0;                  ///< no shadow is farther, not even at its back

  /// About from front to back: an occluder comes after all faces of the shadow but those that are
  /// behind it for certain.
  std::vector<std::uint32_t> order;

  /// @param shadow as `project_shadow` gives it for this view and these faces.
  ShadowInView(const PinholeCamera& view, const ShadowFaces& all, FaceProjector& shadow);

 private:
  /// Of the polygons of one group of the shadow's faces.
  struct GroupDepth {
    std::uint32_t group;
    double nearest_m, last_m;  ///< the smallest and the largest `nearest_m`
  };

  void add_shadow(const PinholeCamera& view, FaceProjector& shadow);
  void add_occluders(const PinholeCamera& view, const ShadowFaces& all);
  double hidden_from_m(const FacePolygon& occluder, const ShadowFaces& all) const;
  void sort();

  std::vector<GroupDepth> groups_;
  double margin_m_ = 0;              ///< how far rounding may move a ray
  std::vector<double> hidden_from_;  ///< of each occluder, as of `hidden_from_m`
};

}  // namespace vantage::planner::detail
