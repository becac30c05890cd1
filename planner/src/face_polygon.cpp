#include "face_polygon.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/raycore/box_projector.hpp"
#include "vantage/raycore/multiversion.hpp"

namespace vantage::detail {
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

/// A camera as plain numbers.
struct Projection {
  double r[9], eye[3];  ///< world to camera
  double fx, fy, cx, cy;
};

struct PointLanes {
  const double *x, *y, *z;
};

VANTAGE_MULTIVERSION
void project_points(const Projection& p, const PointLanes& points, std::size_t count,
                    double* __restrict u, double* __restrict v, double* __restrict depth) {
  for (std::size_t i = 0; i < count; ++i) {
    const double dx = points.x[i] - p.eye[0], dy = points.y[i] - p.eye[1],
                 dz = points.z[i] - p.eye[2];
    const double x = p.r[0] * dx + p.r[1] * dy + p.r[2] * dz;
    const double y = p.r[3] * dx + p.r[4] * dy + p.r[5] * dz;
    const double z = p.r[6] * dx + p.r[7] * dy + p.r[8] * dz;
    const double inverse = 1 / z;
    u[i] = p.fx * x * inverse + p.cx;
    v[i] = p.fy * y * inverse + p.cy;
    depth[i] = z;
  }
}

/// Where eight boxes' corners are on the image at most. Pixels are of no use where `nearest` is not
/// positive.
struct BoxImages {
  double left[kBoxLanes], right[kBoxLanes], top[kBoxLanes], bottom[kBoxLanes];
  double nearest[kBoxLanes], farthest[kBoxLanes];
};

struct BoxPointers {
  const double *x, *y, *z, *half_x, *half_y, *half_z;
};

VANTAGE_MULTIVERSION
void project_boxes(const Projection& p, const BoxPointers& boxes, BoxImages& images) {
  for (std::size_t i = 0; i < kBoxLanes; ++i) {
    images.left[i] = images.top[i] = images.nearest[i] = 1e300;
    images.right[i] = images.bottom[i] = images.farthest[i] = -1e300;
  }
  for (int corner = 0; corner < 8; ++corner) {
    const double sx = (corner & 1) != 0 ? 1 : -1, sy = (corner & 2) != 0 ? 1 : -1,
                 sz = (corner & 4) != 0 ? 1 : -1;
    for (std::size_t i = 0; i < kBoxLanes; ++i) {
      const double dx = boxes.x[i] + sx * boxes.half_x[i] - p.eye[0],
                   dy = boxes.y[i] + sy * boxes.half_y[i] - p.eye[1],
                   dz = boxes.z[i] + sz * boxes.half_z[i] - p.eye[2];
      const double z = p.r[6] * dx + p.r[7] * dy + p.r[8] * dz, inverse = 1 / z;
      const double u = p.fx * (p.r[0] * dx + p.r[1] * dy + p.r[2] * dz) * inverse + p.cx;
      const double v = p.fy * (p.r[3] * dx + p.r[4] * dy + p.r[5] * dz) * inverse + p.cy;
      images.left[i] = u < images.left[i] ? u : images.left[i];
      images.right[i] = u > images.right[i] ? u : images.right[i];
      images.top[i] = v < images.top[i] ? v : images.top[i];
      images.bottom[i] = v > images.bottom[i] ? v : images.bottom[i];
      images.nearest[i] = z < images.nearest[i] ? z : images.nearest[i];
      images.farthest[i] = z > images.farthest[i] ? z : images.farthest[i];
    }
  }
}

Projection projection_of(const Intrinsics& k, const Eigen::Matrix3d& R_cam_world,
                         const Eigen::Vector3d& eye) {
  Projection p{{}, {eye.x(), eye.y(), eye.z()}, k.fx, k.fy, k.cx, k.cy};
  for (int i = 0; i < 9; ++i) p.r[i] = R_cam_world(i / 3, i % 3);
  return p;
}

}  // namespace

FaceProjector::FaceProjector(const PinholeCamera& camera, const FlatFaces& faces)
    : FaceProjector(camera, faces,
                    {{0, camera.intrinsics().width - 1},
                     {0, camera.intrinsics().height - 1},
                     camera.range().far_m}) {}

FaceProjector::FaceProjector(const PinholeCamera& camera, const FlatFaces& faces,
                             const Window& window)
    : faces_(faces),
      image_(camera.intrinsics()),
      window_(window),
      centre_(camera.centre()),
      R_cam_world_(camera.T_world_cam().rotation().transpose()),
      per_fx_(1 / image_.fx),
      per_fy_(1 / image_.fy),
      margin_m_(kRoundingOfRays *
                std::max(faces.largest_coordinate_m, camera.centre().cwiseAbs().maxCoeff())),
      // du = fx (dx - x/z dz) / z, and the same for v.
      pixels_per_radian_(std::max(image_.fx, image_.fy) * 2 * (1 + farthest_tangent(image_))),
      clip_m_(
          std::max(camera.range().near_m * (1 - 1e-3) - margin_m_, 0.5 * camera.range().near_m)),
      lowest_m_(-margin_m_ / kFlattest) {
  find_groups();
}

void FaceProjector::see_backs() {
  lowest_m_ = -1e300;
  for (GroupInView& group : groups_) group.facing = true;
}

void FaceProjector::find_groups() {
  const Projection projection = projection_of(image_, R_cam_world_, centre_);
  const BoxLanes& boxes = faces_.boxes;
  BoxImages images;
  std::uint32_t most_corners = 0;
  for (std::uint32_t g = 0; g < faces_.groups.size(); ++g) {
    const std::size_t lane = g % kBoxLanes;
    if (lane == 0) {
      project_boxes(projection,
                    {&boxes.centre_x[g], &boxes.centre_y[g], &boxes.centre_z[g], &boxes.half_x[g],
                     &boxes.half_y[g], &boxes.half_z[g]},
                    images);
    }
    const FlatFaces::Group& group = faces_.groups[g];
    const double rounding = worst_rounding(group);
    GroupInView seen{
        .index = g,
        .columns = window_.columns,
        .rows = window_.rows,
        .farthest_m = images.farthest[lane] / (1 - std::min(rounding, kFlattest)) + margin_m_,
        .grazing = rounding > kFlattest,
        .facing = !group.parallel ||
                  faces_.list[group.first_face].normal.dot(centre_) - group.lowest_m >= lowest_m_};
    if (images.farthest[lane] < clip_m_ || !in_depth(images.nearest[lane])) continue;
    if (images.nearest[lane] > clip_m_) {
      const double margin = margin_px(images.nearest[lane]);
      seen.columns = whole(images.left[lane] - margin, images.right[lane] + margin, seen.columns);
      seen.rows = whole(images.top[lane] - margin, images.bottom[lane] + margin, seen.rows);
    }
    if (seen.columns.last < 0 || seen.rows.last < 0) continue;
    farthest_m_ = std::max(farthest_m_, seen.farthest_m);
    most_corners = std::max(most_corners, group.last_corner - group.first_corner);
    groups_.push_back(seen);
  }
  u_.reset(new double[most_corners]);
  v_.reset(new double[most_corners]);
  depth_.reset(new double[most_corners]);
}

/// By which share at most rounding moves depths on a group's faces, but for those that are grazing
/// anyway: 1 or more for these.
double FaceProjector::worst_rounding(const FlatFaces::Group& group) const {
  const FlatFaces::Face& first = faces_.list[group.first_face];
  const double along_m = first.normal.dot(centre_);
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
  const PointLanes points{&faces_.x[loaded_], &faces_.y[loaded_], &faces_.z[loaded_]};
  project_points(projection_of(image_, R_cam_world_, centre_), points,
                 group.last_corner - group.first_corner, u_.get(), v_.get(), depth_.get());
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
    const std::uint32_t c = face.corners[i] - loaded_;
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
  const double rounding = margin_m_ / std::max(distance_m, 1e-30);
  polygon.grazing = rounding > kFlattest;
  if (polygon.grazing) polygon.certain_rows = {0, -1};
  const double towards = height_m > 0 ? -1 : 1;
  const double scale = polygon.grazing ? 0 : towards * (1 - rounding) / distance_m;
  const double b = scale * outwards_.x() * per_fx_, c = scale * outwards_.y() * per_fy_;
  const double a = scale * outwards_.z() - b * image_.cx - c * image_.cy;
  const double float_error =
      kFloat * (std::abs(a) + std::abs(b) * image_.width + std::abs(c) * image_.height);
  polygon.at_origin = float(a - float_error);
  const double farthest_m = std::min(corners.farthest_m, window_.farthest_m);
  polygon.least_inverse = float((1 - std::min(rounding, kFlattest)) * (1 - kFloat) / farthest_m);
  polygon.per_u = float(b);
  polygon.per_v = float(c);
  polygon.nearest_m = polygon.grazing ? 0 : corners.nearest_m * (1 - rounding) - margin_m_;
  polygon.farthest_m = corners.farthest_m * (1 + rounding) + margin_m_;
}

}  // namespace vantage::detail
