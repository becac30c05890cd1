#include "scoring/shadow/shadow_in_view.hpp"

#include <algorithm>
#include <cmath>

namespace vantage::planner::detail {
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

ShadowFaces::ShadowFaces(const PlanningScene& scene)
    : shadow(rectangles_of(scene.shadow_faces())), occluders(largest_faces_of(scene.occluders())) {
  behind_m_.reserve(occluders.list.size() * shadow.groups.size());
  const BoxLanes& boxes = shadow.boxes;
  for (const FlatFaces::Face& face : occluders.list) {
    const Eigen::Vector3d n = face.normal, reach = n.cwiseAbs();
    for (std::size_t i = 0; i < shadow.groups.size(); ++i) {
      const double middle_m =
          n.dot(Eigen::Vector3d(boxes.centre_x[i], boxes.centre_y[i], boxes.centre_z[i]));
      const double half_m =
          reach.dot(Eigen::Vector3d(boxes.half_x[i], boxes.half_y[i], boxes.half_z[i]));
      behind_m_.push_back(float(face.offset_m - middle_m - half_m));
    }
  }
}

bool too_uncertain(const FaceProjector& projector, const PinholeCamera& view) {
  return !(projector.margin_m() < 0.1 * view.range().near_m);
}

FacePolygon whole_image(const PinholeCamera& view) {
  FacePolygon all{};
  all.columns = {0, view.intrinsics().width - 1};
  all.rows = {0, view.intrinsics().height - 1};
  all.certain_rows = {0, -1};
  all.grazing = true;
  all.min_inverse = float(1 / view.range().far_m);
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
                           FaceProjector& shadow) {
  if (all.shadow.list.empty()) return;
  add_shadow(view, shadow);
  shadow_count = polygons.size();
  if (shadow_count == 0) return;
  add_occluders(view, all);
  sort();
}

void ShadowInView::add_shadow(const PinholeCamera& view, FaceProjector& shadow) {
  if (too_uncertain(shadow, view)) {
    farthest_m = view.range().far_m;
    polygons.push_back(whole_image(view));
  } else {
    farthest_m = shadow.farthest_m();
    margin_m_ = shadow.margin_m();
    for (const FaceProjector::GroupInView& group : shadow.groups()) {
      GroupDepth depth{group.index, 1e300, -1};
      shadow.for_each_face(group, [&](const FlatFaces::Face& face) {
        FacePolygon& polygon = polygons.emplace_back();
        if (!shadow.project(face, polygon)) return polygons.pop_back();
        depth.nearest_m = std::min(depth.nearest_m, polygon.nearest_m);
        depth.last_m = std::max(depth.last_m, polygon.nearest_m);
      });
      if (depth.last_m >= 0) groups_.push_back(depth);
    }
  }
  for (const FacePolygon& face : polygons) widen(columns, face.columns), widen(rows, face.rows);
}

void ShadowInView::add_occluders(const PinholeCamera& view, const ShadowFaces& all) {
  if (all.occluders.list.empty() || groups_.empty()) return;
  FaceProjector projector(view, all.occluders, {columns, rows, farthest_m});
  if (too_uncertain(projector, view)) return;
  margin_m_ = std::max(margin_m_, projector.margin_m());
  double last_m = 0;
  for (const GroupDepth& group : groups_) last_m = std::max(last_m, group.last_m);
  for (const FaceProjector::GroupInView& group : projector.groups()) {
    projector.for_each_face(group, [&](const FlatFaces::Face& face) {
      FacePolygon& polygon = polygons.emplace_back();
      polygon.origin = std::uint32_t(&face - all.occluders.list.data());
      if (!projector.project(face, polygon) || polygon.certain_rows.last < 0) {
        return polygons.pop_back();
      }
      const double from_m = hidden_from_m(polygon, all);
      from_m < last_m ? hidden_from_.push_back(from_m) : polygons.pop_back();
    });
  }
}

/// The depth from which on all polygons of the shadow are behind an occluder for certain: farther
/// away, or beyond its plane. (The camera is on the plane's other side, or else nothing would be
/// certain of it.)
double ShadowInView::hidden_from_m(const FacePolygon& occluder, const ShadowFaces& all) const {
  double from_m = -1;
  for (const GroupDepth& group : groups_) {
    if (group.nearest_m > occluder.farthest_m) continue;
    if (double(all.behind_m(occluder.origin, group.group)) > 4 * margin_m_) continue;
    from_m = std::max(from_m, std::min(group.last_m, occluder.farthest_m));
  }
  return from_m;
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
  // An occluder goes behind all faces of the step where it begins to hide.
  const auto place = [&](std::size_t i) {
    return i < shadow_count ? 2 * step(polygons[i].nearest_m) + 3
                            : 2 * step(hidden_from_[i - shadow_count]) + 4;
  };
  std::vector<std::uint32_t> begin(2 * kSteps + 6);
  for (std::size_t i = 0; i < polygons.size(); ++i) ++begin[std::size_t(place(i)) + 1];
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  order.resize(polygons.size());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    order[begin[std::size_t(place(i))]++] = std::uint32_t(i);
  }
}

}  // namespace vantage::planner::detail
