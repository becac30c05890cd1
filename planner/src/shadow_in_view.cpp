#include "shadow_in_view.hpp"

#include <algorithm>
#include <cmath>

namespace vantage::detail {
namespace {

/// Whether there is shadow around a point: its back faces are then seen as well.
bool in_shadow(const StateGrid& grid, const Eigen::Vector3d& point, double margin_m) {
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d offset((corner & 1) != 0 ? margin_m : -margin_m,
                                 (corner & 2) != 0 ? margin_m : -margin_m,
                                 (corner & 4) != 0 ? margin_m : -margin_m);
    const auto voxel = grid.geometry().voxel_at(point + offset);
    if (voxel && grid.at(*voxel) == VoxelState::shadow) return true;
  }
  return false;
}

}  // namespace

ShadowInView::ShadowInView(const PinholeCamera& view, const ShadowRectangles& rectangles,
                           const StateGrid& grid) {
  const FaceProjector projector(view, rectangles.largest_coordinate_m);
  if (rectangles.list.empty()) return;
  if (!(projector.margin_m() < 0.1 * view.range().near_m)) {
    farthest_m = view.range().far_m;
    add_whole_image(view.intrinsics(), view.range());
    return;
  }
  add_faces(projector, view, rectangles, in_shadow(grid, view.centre(), projector.margin_m()));
  std::sort(faces.begin(), faces.end(),
            [](const FacePolygon& a, const FacePolygon& b) { return a.nearest_m < b.nearest_m; });
}

void ShadowInView::add_faces(const FaceProjector& projector, const PinholeCamera& view,
                             const ShadowRectangles& rectangles, bool from_inside) {
  // The rays' depths err by a hundredth at most where faces are not seen too flat.
  constexpr double kRoundingOfDepths = 1.02;
  std::vector<Eigen::Vector3d> corners(rectangles.corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    corners[i] = projector.to_camera(rectangles.corners[i]);
    farthest_m = std::max(farthest_m, corners[i].z() * kRoundingOfDepths);
  }
  const Eigen::Matrix3d R_cam_world = view.T_world_cam().rotation().transpose();
  faces.reserve(rectangles.list.size());
  for (const ShadowRectangle& r : rectangles.list) {
    const double height_m = r.sign * (view.centre()[r.axis] - r.position_m);
    if (height_m < -projector.margin_m() && !from_inside) continue;
    const Eigen::Vector3d seen[] = {corners[r.corners[0]], corners[r.corners[1]],
                                    corners[r.corners[2]], corners[r.corners[3]]};
    const Eigen::Vector3d inwards = (height_m > 0 ? -r.sign : r.sign) * R_cam_world.col(r.axis);
    FacePolygon face;
    if (!projector.project(seen, inwards, std::abs(height_m), face)) continue;
    const auto widen = [](PixelSpan& all, const PixelSpan& one) {
      all = all.last < 0 ? one
                         : PixelSpan{std::min(all.first, one.first), std::max(all.last, one.last)};
    };
    widen(columns, face.columns);
    widen(rows, face.rows);
    faces.push_back(face);
  }
}

void ShadowInView::add_whole_image(const Intrinsics& image, const DepthRange& range) {
  FacePolygon all{};
  all.columns = columns = {0, image.width - 1};
  all.rows = rows = {0, image.height - 1};
  all.certain_rows = {0, -1};
  all.grazing = true;
  all.least_inverse = float(1 / range.far_m);
  faces.push_back(all);
}

}  // namespace vantage::detail
