#include "scoring/shadow/face_polygon.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/raycore/detail/box_projector.hpp"

namespace vantage::planner::detail {
namespace {

// The spans are computed in float, from columns of some thousand pixels.
constexpr double kRoundingOfSpans_px = 1e-3;
constexpr double kFloat = 0x1p-21;  // some roundings, one after the other

// Depths are known of faces for which rounding moves them by less than this share.
constexpr double kFlattest = 0.2;

/// The whole numbers in [low, high] that are in a span, which has no negative ones. Conversions cut
/// off; calls that round take longer than all else here.
PixelSpan whole(double low, double high, const PixelSpan& span) {
  const double l = std::clamp(low, double(span.first), span.last + 1.0);
  const double h = std::clamp(high, -1.0, double(span.last));
  const int first = int(l) + (double(int(l)) < l), last = int(h + 1) - 1;
  return first <= last ? PixelSpan{first, last} : PixelSpan{0, -1};
}

double farthest_tangent(const Intrinsics& k) {
  const double x = std::max(std::abs(k.cx + 1), std::abs(k.width - k.cx)) / k.fx;
  const double y = std::max(std::abs(k.cy + 1), std::abs(k.height - k.cy)) / k.fy;
  return x + y;
}

}  // namespace

FaceProjector::Window FaceProjector::whole_image(const PinholeCamera& camera) {
  return {{0, camera.intrinsics().width - 1},
          {0, camera.intrinsics().height - 1},
          camera.range().far_m};
}

double FaceProjector::margin_m(const PinholeCamera& camera, const FlatFaces& faces) {
  return kRoundingOfRays *
         std::max(faces.largest_coordinate_m, camera.centre().cwiseAbs().maxCoeff());
}

FaceProjector::FaceProjector(const PinholeCamera& camera, const FlatFaces& faces,
                             const Window& window, bool from_inside)
    : faces_(faces),
      image_(camera.intrinsics()),
      window_(window),
      projection_(camera),
      centre_(camera.centre()),
      R_cam_world_(camera.T_world_cam().rotation().transpose()),
      per_fx_(1 / image_.fx),
      per_fy_(1 / image_.fy),
      margin_m_(margin_m(camera, faces)),
      // du = fx (dx - x/z dz) / z, and the same for v.
      pixels_per_radian_(std::max(image_.fx, image_.fy) * 2 * (1 + farthest_tangent(image_))),
      clip_m_(
          std::max(camera.range().near_m * (1 - 1e-3) - margin_m_, 0.5 * camera.range().near_m)),
      lowest_m_(from_inside ? -1e300 : -margin_m_ / kFlattest) {
  find_groups();
}

void FaceProjector::find_groups() {
  BoxImages images;
  std::size_t projected =
      ~std::size_t(0);  // number of groups of eight boxes before those in `images`
  for (std::uint32_t g = 0; g < faces_.groups.size(); ++g) {
    const FlatFaces::Group& group = faces_.groups[g];
    if (group.parallel && along_m(group) - group.lowest_m < lowest_m_) continue;
    if (projected != g / kBoxLanes) {
      projected = g / kBoxLanes;
      project_boxes(projection_, faces_.boxes, projected * kBoxLanes, images);
    }
    const std::size_t lane = g % kBoxLanes;
    if (images.farthest[lane] < clip_m_ || !in_depth(images.nearest[lane])) continue;
    GroupInView seen{g, window_.columns, window_.rows};
    if (images.nearest[lane] > clip_m_) {
      const double margin = margin_px(images.nearest[lane]);
      seen.columns = whole(images.left[lane] - margin, images.right[lane] + margin, seen.columns);
      seen.rows = whole(images.top[lane] - margin, images.bottom[lane] + margin, seen.rows);
    }
    if (seen.columns.last >= 0 && seen.rows.last >= 0) groups_.push_back(seen);
  }
}

double FaceProjector::farthest_m() const {
  const BoxLanes& boxes = faces_.boxes;
  const Eigen::Vector3d axis = R_cam_world_.row(2), reach = axis.cwiseAbs();
  double farthest_m = 0;
  for (std::size_t i = 0; i < faces_.groups.size(); ++i) {
    const double middle_m = axis.dot(
        Eigen::Vector3d(boxes.centre_x[i], boxes.centre_y[i], boxes.centre_z[i]) - centre_);
    const double depth_m =
        middle_m + reach.dot(Eigen::Vector3d(boxes.half_x[i], boxes.half_y[i], boxes.half_z[i]));
    if (depth_m <= 0) continue;
    const double rounding = std::min(worst_rounding(faces_.groups[i]), kFlattest);
    farthest_m = std::max(farthest_m, depth_m / (1 - rounding));
  }
  return farthest_m + margin_m_;
}

bool FaceProjector::may_be_grazing() const {
  return std::any_of(groups_.begin(), groups_.end(), [&](const GroupInView& group) {
    return !(worst_rounding(faces_.groups[group.index]) < kFlattest);
  });
}

/// How far the camera is along the normal of a group whose faces are parallel.
double FaceProjector::along_m(const FlatFaces::Group& group) const {
  return faces_.list[group.first_face].normal.dot(centre_);
}

/// By which share at most rounding moves depths on a group's faces, but for those that are grazing
/// anyway.
double FaceProjector::worst_rounding(const FlatFaces::Group& group) const {
  const double along_m = this->along_m(group);
  const double off_m = std::max(group.lowest_m - along_m, along_m - group.highest_m);
  if (group.parallel && off_m > 0) return margin_m_ / off_m;
  double nearest_m = 1e300;
  for (std::uint32_t i = group.first_face; i < group.last_face; ++i) {
    nearest_m = std::min(nearest_m, std::abs(height_m(faces_.list[i])));
  }
  return margin_m_ / std::max(nearest_m, 1e-30);
}

double FaceProjector::margin_px(double nearest_m) const {
  return pixels_per_radian_ * margin_m_ / nearest_m + kRoundingOfSpans_px;
}

void FaceProjector::load_corners(const FlatFaces::Group& group) {
  loaded_ = group.first_corner;
  outwards_ = R_cam_world_ * faces_.list[group.first_face].normal;
  project_points(projection_, {&faces_.x[loaded_], &faces_.y[loaded_], &faces_.z[loaded_]},
                 group.last_corner - group.first_corner, u_.data(), v_.data(), depth_.data());
}

bool FaceProjector::project(const FlatFaces::Face& face, FacePolygon& polygon) const {
  Corners corners;
  if (!project_corners(face, corners, polygon)) return false;
  polygon.certain_rows =
      whole(corners.top + corners.margin, corners.bottom - corners.margin, window_.rows);
  set_edges(corners, polygon);
  set_depth(face, corners, polygon);
  return true;
}

void FaceProjector::set_outline(const Corners& corners, FacePolygon& polygon) const {
  constexpr int kSmall_px = 4;
  const int columns = polygon.columns.last - polygon.columns.first;
  const int rows = polygon.rows.last - polygon.rows.first;
  polygon.left_edges = polygon.right_edges = 0;
  if (std::min(columns, rows) > 0 && std::max(columns, rows) >= kSmall_px) {
    set_edges(corners, polygon);
  }
}

bool FaceProjector::project_corners(const FlatFaces::Face& face, Corners& corners,
                                    FacePolygon& polygon) const {
  double z0 = 1e300, z1 = -1e300;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t c = face.corners[i] - loaded_;
    corners.u[i] = u_[c], corners.v[i] = v_[c];
    z0 = std::min(z0, depth_[c]), z1 = std::max(z1, depth_[c]);
  }
  if (z1 < clip_m_ || !in_depth(z0)) return false;
  corners.count = 4;
  if (z0 < clip_m_) {
    clip(face, corners);
    z0 = clip_m_;
  }
  corners.nearest_m = z0, corners.farthest_m = z1;
  corners.margin = margin_px(z0);
  double u0 = 1e300, u1 = -1e300, v0 = 1e300, v1 = -1e300;
  for (int i = 0; i < corners.count; ++i) {
    u0 = std::min(u0, corners.u[i]), u1 = std::max(u1, corners.u[i]);
    v0 = std::min(v0, corners.v[i]), v1 = std::max(v1, corners.v[i]);
  }
  corners.top = v0, corners.bottom = v1;
  polygon.columns = whole(u0 - corners.margin, u1 + corners.margin, window_.columns);
  polygon.rows = whole(v0 - corners.margin, v1 + corners.margin, window_.rows);
  return polygon.columns.last >= 0 && polygon.rows.last >= 0;
}

/// The part that is not nearer than `clip_m_`: at most five corners.
void FaceProjector::clip(const FlatFaces::Face& face, Corners& corners) const {
  const auto in_camera = [&](std::size_t i) -> Eigen::Vector3d {
    const std::uint32_t c = face.corners[i];
    return R_cam_world_ * (Eigen::Vector3d(faces_.x[c], faces_.y[c], faces_.z[c]) - centre_);
  };
  corners.count = 0;
  const auto add = [&](const Eigen::Vector3d& p, double depth) {
    corners.u[corners.count] = image_.fx * p.x() / depth + image_.cx;
    corners.v[corners.count++] = image_.fy * p.y() / depth + image_.cy;
  };
  for (std::size_t i = 0; i < 4; ++i) {
    const Eigen::Vector3d p = in_camera(i), q = in_camera((i + 1) % 4);
    if (p.z() >= clip_m_) add(p, p.z());
    if ((p.z() >= clip_m_) == (q.z() >= clip_m_)) continue;
    add(p + (clip_m_ - p.z()) / (q.z() - p.z()) * (q - p), clip_m_);
  }
}

void FaceProjector::set_edges(const Corners& corners, FacePolygon& polygon) const {
  const int count = corners.count;
  double mid_u = 0, mid_v = 0;
  for (int i = 0; i < count; ++i) mid_u += corners.u[i], mid_v += corners.v[i];
  mid_u /= count, mid_v /= count;
  polygon.left_edges = polygon.right_edges = 0;
  for (int i = 0; i < count; ++i) {
    const int next = i + 1 < count ? i + 1 : 0;
    const double pu = corners.u[i], pv = corners.v[i];
    const double du = corners.u[next] - pu, dv = corners.v[next] - pv;
    // `rows` and `certain_rows` stand for edges that run along them.
    if (std::abs(dv) <= 1e-6 * std::abs(du)) continue;
    const double slope = du / dv, offset = pu - slope * pv;
    const double slack = corners.margin * (1 + std::abs(slope)) +
                         kFloat * (std::abs(slope) * image_.height + std::abs(offset));
    const double inside = mid_u - (slope * mid_v + offset);
    if (std::abs(inside) <= slack) {  // a sliver: which side is which?
      polygon.certain_rows = {0, -1};
    } else if (inside > 0) {
      polygon.left[polygon.left_edges++] = {float(slope), float(offset - slack),
                                            float(offset + slack)};
    } else {
      polygon.right[polygon.right_edges++] = {float(slope), float(offset + slack),
                                              float(offset - slack)};
    }
  }
}

void FaceProjector::set_depth(const FlatFaces::Face& face, const Corners& corners,
                              FacePolygon& polygon) const {
  // A point at depth z in the direction (x, y, 1) is on the plane: z · normal · (x, y, 1) =
  // distance.
  const double height_m = this->height_m(face), distance_m = std::abs(height_m);
  const double per_distance = 1 / std::max(distance_m, 1e-30), rounding = margin_m_ * per_distance;
  polygon.grazing = rounding > kFlattest;
  if (polygon.grazing) polygon.certain_rows = {0, -1};
  const double towards = height_m > 0 ? -1 : 1;
  const double scale = polygon.grazing ? 0 : towards * (1 - rounding) * per_distance;
  const double b = scale * outwards_.x() * per_fx_, c = scale * outwards_.y() * per_fy_;
  const double a = scale * outwards_.z() - b * image_.cx - c * image_.cy;
  const double float_error =
      kFloat * (std::abs(a) + std::abs(b) * image_.width + std::abs(c) * image_.height);
  polygon.at_origin = float(a - float_error);
  const double farthest_m = std::min(corners.farthest_m, window_.farthest_m);
  polygon.min_inverse = float((1 - std::min(rounding, kFlattest)) * (1 - kFloat) / farthest_m);
  polygon.per_u = float(b);
  polygon.per_v = float(c);
  polygon.nearest_m = polygon.grazing ? 0 : corners.nearest_m * (1 - rounding) - margin_m_;
  polygon.farthest_m = corners.farthest_m * (1 + rounding) + margin_m_;
}

}  // namespace vantage::planner::detail
