#pragma once

#include <vector>

#include "face_polygon.hpp"
#include "shadow_rectangles.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage::detail {

/// The faces of the shadow that a view's rays may meet first, from front to back, as far as they
/// are on the image and in the depth range. From outside, those are the faces that look at the
/// camera.
struct ShadowInView {
  std::vector<FacePolygon> faces;
  PixelSpan columns{0, -1}, rows{0, -1};  ///< all of them lie in there
  double farthest_m = 0;                  ///< no shadow is farther, not even at its back

  /// @param rectangles the shadow of `grid`.
  ShadowInView(const PinholeCamera& view, const ShadowRectangles& rectangles,
               const StateGrid& grid);

 private:
  void add_faces(const FaceProjector& projector, const PinholeCamera& view,
                 const ShadowRectangles& rectangles, bool from_inside);
  void add_whole_image(const Intrinsics& image, const DepthRange& range);
};

}  // namespace vantage::detail
