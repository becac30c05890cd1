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

template <class Keep>
void add_polygons(FaceProjector& projector, const Keep& keep, std::vector<FacePolygon>& polygons) {
  for (const FaceProjector::GroupInView& group : projector.groups()) {
    projector.for_each_face(group, [&](const FlatFaces::Face& face) {
      FacePolygon& polygon = polygons.emplace_back();
      if (!projector.project(face, polygon) || !keep(polygon)) polygons.pop_back();
    });
  }
}

}  // namespace

bool too_uncertain(const FaceProjector& projector, const PinholeCamera& view) {
  return !(projector.margin_m() < 0.1 * view.range().near_m);
}

FacePolygon whole_image(const PinholeCamera& view) {
  FacePolygon all{};
  all.columns = {0, view.intrinsics().width - 1};
  all.rows = {0, view.intrinsics().height - 1};
  all.certain_rows = {0, -1};
  all.grazing = true;
  all.least_inverse = float(1 / view.range().far_m);
  all.farthest_m = view.range().far_m;
  return all;
}

void widen(PixelSpan& all, const PixelSpan& one) {
  all =
      all.last < 0 ? one : PixelSpan{std::min(all.first, one.first), std::max(all.last, one.last)};
}

FaceProjector project_shadow(const PinholeCamera& view, const ShadowFaces& all,
                             const StateGrid& grid) {
  const double margin_m = FaceProjector::margin_m(view, all.shadow);
  return {view, all.shadow, FaceProjector::whole_image(view),
          in_shadow(grid, view.centre(), margin_m)};
}

ShadowInView::ShadowInView(const PinholeCamera& view, const ShadowFaces& all,
                           const StateGrid& grid) {
  if (all.shadow.list.empty()) return;
  add_shadow(view, all, grid);
  shadow_count = polygons.size();
  if (shadow_count == 0) return;
  add_occluders(view, all.occluders);
  sort();
}

void ShadowInView::add_shadow(const PinholeCamera& view, const ShadowFaces& all,
                              const StateGrid& grid) {
  FaceProjector projector = project_shadow(view, all, grid);
  if (too_uncertain(projector, view)) {
    farthest_m = view.range().far_m;
    polygons.push_back(whole_image(view));
  } else {
    farthest_m = projector.farthest_m();
    add_polygons(
        projector, [](const FacePolygon&) { return true; }, polygons);
  }
  for (const FacePolygon& face : polygons) widen(columns, face.columns), widen(rows, face.rows);
}

void ShadowInView::add_occluders(const PinholeCamera& view, const FlatFaces& occluders) {
  if (occluders.list.empty()) return;
  FaceProjector projector(view, occluders, {columns, rows, farthest_m});
  if (too_uncertain(projector, view)) return;
  double last_m = 0;
  for (const FacePolygon& face : polygons) last_m = std::max(last_m, face.nearest_m);
  add_polygons(
      projector,
      [&](const FacePolygon& polygon) {
        return polygon.certain_rows.last >= 0 && polygon.farthest_m < last_m;
      },
      polygons);
}

void ShadowInView::sort() {
  constexpr int kSteps = 512;
  double nearest = 1e300, farthest = 0;
  for (std::size_t i = 0; i < shadow_count; ++i) {
    nearest = std::min(nearest, polygons[i].nearest_m);
    farthest = std::max(farthest, polygons[i].nearest_m);
  }
  const double per_m = (kSteps - 1) / std::max(farthest - nearest, 1e-9);
  const auto step = [&](double depth_m) {
    return int(std::floor(std::clamp((depth_m - nearest) * per_m, -1.0, double(kSteps))));
  };
  // An occluder goes to the step behind its farthest point, in front of the faces there.
  const auto place = [&](std::size_t i) {
    const FacePolygon& p = polygons[i];
    return i < shadow_count ? 2 * step(p.nearest_m) + 3 : 2 * step(p.farthest_m) + 4;
  };
  std::vector<std::uint32_t> begin(2 * kSteps + 6);
  for (std::size_t i = 0; i < polygons.size(); ++i) ++begin[std::size_t(place(i)) + 1];
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  order.resize(polygons.size());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    order[begin[std::size_t(place(i))]++] = std::uint32_t(i);
  }
}

}  // namespace vantage::detail
