#pragma once

#include <cstdint>
#include <vector>

#include "face_polygon.hpp"
#include "flat_faces.hpp"
#include "vantage/planner/planning_scene.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage::detail {

/// What is known before any view: the shadow's faces, and those of what may hide it.
struct ShadowFaces {
  FlatFaces shadow, occluders;

  explicit ShadowFaces(const PlanningScene& scene)
      : shadow(rectangles_of(scene.shadow_faces())),
        occluders(largest_faces_of(scene.occluders())) {}
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
  std::size_t shadow_count = 0;           ///< so many are the shadow's
  PixelSpan columns{0, -1}, rows{0, -1};  ///< all polygons lie in there
  double farthest_m = 0;                  ///< no shadow is farther, not even at its back

  /// About from front to back: an occluder comes before those faces of the shadow that are behind
  /// it for certain, and after all others.
  std::vector<std::uint32_t> order;

  /// @param grid that the faces were made from.
  ShadowInView(const PinholeCamera& view, const ShadowFaces& all, const StateGrid& grid);

 private:
  void add_shadow(const PinholeCamera& view, const ShadowFaces& all, const StateGrid& grid);
  void add_occluders(const PinholeCamera& view, const FlatFaces& occluders);
  void sort();
};

}  // namespace vantage::detail
