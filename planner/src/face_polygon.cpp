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

/// A camera and faces' corners, as plain numbers.
struct CornerJob {
  double r[9], eye[3];  ///< world to camera
  double fx, fy, cx, cy;
  const double *x, *y, *z;
};

VANTAGE_MULTIVERSION
void project_all(const CornerJob& job, std::size_t count, double* __restrict u,
                 double* __restrict v, double* __restrict depth) {
  for (std::size_t i = 0; i < count; ++i) {
    const double dx = job.x[i] - job.eye[0], dy = job.y[i] - job.eye[1], dz = job.z[i] - job.eye[2];
    const double x = job.r[0] * dx + job.r[1] * dy + job.r[2] * dz;
    const double y = job.r[3] * dx + job.r[4] * dy + job.r[5] * dz;
    const double z = job.r[6] * dx + job.r[7] * dy + job.r[8] * dz;
    const double inverse = 1 / z;
    u[i] = job.fx * x * inverse + job.cx;
    v[i] = job.fy * y * inverse + job.cy;
    depth[i] = z;
  }
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
      margin_m_(kRoundingOfRays *
                std::max(faces.largest_coordinate_m, camera.centre().cwiseAbs().maxCoeff())),
      // du = fx (dx - x/z dz) / z, and the same for v.
      pixels_per_radian_(std::max(image_.fx, image_.fy) * 2 * (1 + farthest_tangent(image_))),
      clip_m_(
          std::max(camera.range().near_m * (1 - 1e-3) - margin_m_, 0.5 * camera.range().near_m)),
      u_(new double[faces.x.size()]),
      v_(new double[faces.x.size()]),
      depth_(new double[faces.x.size()]) {
  CornerJob job{{},
                {centre_.x(), centre_.y(), centre_.z()},
                image_.fx,
                image_.fy,
                image_.cx,
                image_.cy,
                faces.x.data(),
                faces.y.data(),
                faces.z.data()};
  for (int i = 0; i < 9; ++i) job.r[i] = R_cam_world_(i / 3, i % 3);
  const std::size_t count = faces.x.size();
  project_all(job, count, u_.get(), v_.get(), depth_.get());
  for (std::size_t i = 0; i < count; ++i) farthest_m_ = std::max(farthest_m_, depth_[i]);
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

bool FaceProjector::project_outline(const FlatFaces::Face& face, FacePolygon& polygon) const {
  constexpr int kSmall_px = 4;
  Corners corners;
  if (!project_corners(face, corners, polygon)) return false;
  const int columns = polygon.columns.last - polygon.columns.first;
  const int rows = polygon.rows.last - polygon.rows.first;
  polygon.left_edges = polygon.right_edges = 0;
  if (std::min(columns, rows) > 0 && std::max(columns, rows) >= kSmall_px) {
    set_edges(corners, polygon);
  }
  return true;
}

bool FaceProjector::project_corners(const FlatFaces::Face& face, Corners& corners,
                                    FacePolygon& polygon) const {
  double z0 = 1e300, z1 = -1e300;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::uint32_t c = face.corners[i];
    corners.u[i] = u_[c], corners.v[i] = v_[c];
    z0 = std::min(z0, depth_[c]), z1 = std::max(z1, depth_[c]);
  }
  if (z1 < clip_m_ || z0 > window_.farthest_m * (1 + 1e-3) + margin_m_) return false;
  corners.count = 4;
  if (z0 < clip_m_) {
    clip(face, corners);
    z0 = clip_m_;
  }
  corners.nearest_m = z0, corners.farthest_m = z1;
  corners.margin = pixels_per_radian_ * margin_m_ / z0 + kRoundingOfSpans_px;
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
  constexpr double kFlattest = 0.01;
  const double height_m = this->height_m(face), distance_m = std::abs(height_m);
  const Eigen::Vector3d outwards = R_cam_world_ * face.normal;
  const Eigen::Vector3d normal = height_m > 0 ? Eigen::Vector3d(-outwards) : outwards;
  const double rounding = margin_m_ / std::max(distance_m, 1e-30);
  polygon.grazing = rounding > kFlattest;
  if (polygon.grazing) polygon.certain_rows = {0, -1};
  const double scale = polygon.grazing ? 0 : (1 - rounding) / distance_m;
  const double side =
      normal.dot(Eigen::Vector3d(-image_.cx / image_.fx, -image_.cy / image_.fy, 1));
  const double a = scale * side, b = scale * normal.x() / image_.fx,
               c = scale * normal.y() / image_.fy;
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
