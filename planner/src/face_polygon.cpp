#include "face_polygon.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "vantage/raycore/box_projector.hpp"

namespace vantage::detail {
namespace {

// The spans are computed in float, from columns of some thousand pixels.
constexpr double kRoundingOfSpans_px = 1e-3;
constexpr double kFloat = 0x1p-21;  // some roundings, one after the other

/// The part of a quadrilateral that is not nearer than `near_m`: at most five corners.
int clip(const Eigen::Vector3d (&corners)[4], double near_m, Eigen::Vector3d* clipped) {
  int count = 0;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d &p = corners[i], &q = corners[(i + 1) % 4];
    if (p.z() >= near_m) clipped[count++] = p;
    if ((p.z() >= near_m) == (q.z() >= near_m)) continue;
    clipped[count] = p + (near_m - p.z()) / (q.z() - p.z()) * (q - p);
    clipped[count++].z() = near_m;
  }
  return count;
}

/// The whole numbers in [low, high] that are in [0, size).
PixelSpan whole(double low, double high, int size) {
  const double first = std::ceil(std::max(low, 0.0)), last = std::floor(std::min(high, size - 1.0));
  return first <= last ? PixelSpan{int(first), int(last)} : PixelSpan{0, -1};
}

double farthest_tangent(const Intrinsics& k) {
  const double x = std::max(std::abs(k.cx + 1), std::abs(k.width - k.cx)) / k.fx;
  const double y = std::max(std::abs(k.cy + 1), std::abs(k.height - k.cy)) / k.fy;
  return x + y;
}

}  // namespace

FaceProjector::FaceProjector(const PinholeCamera& camera, double largest_coordinate_m)
    : image_(camera.intrinsics()),
      range_(camera.range()),
      centre_(camera.centre()),
      R_cam_world_(camera.T_world_cam().rotation().transpose()),
      margin_m_(kRoundingOfRays *
                std::max(largest_coordinate_m, camera.centre().cwiseAbs().maxCoeff())),
      // du = fx (dx - x/z dz) / z, and the same for v.
      pixels_per_radian_(std::max(image_.fx, image_.fy) * 2 * (1 + farthest_tangent(image_))) {}

bool FaceProjector::project(const Eigen::Vector3d (&corners)[4], const Eigen::Vector3d& normal,
                            double distance_m, FacePolygon& polygon) const {
  double z0 = corners[0].z(), z1 = z0;
  for (int i = 1; i < 4; ++i) {
    z0 = std::min(z0, corners[i].z());
    z1 = std::max(z1, corners[i].z());
  }
  // What is nearer than near is not counted.
  const double near_m = range_.near_m * (1 - 1e-3) - margin_m_;
  const double clip_m = std::max(near_m, 0.5 * range_.near_m);
  if (z1 < clip_m || z0 > range_.far_m * (1 + 1e-3) + margin_m_) return false;
  Eigen::Vector3d clipped[FacePolygon::kMostEdges + 3];
  int count = 4;
  if (z0 < clip_m) {
    count = clip(corners, clip_m, clipped);
    z0 = clip_m;
  } else {
    std::copy(std::begin(corners), std::end(corners), clipped);
  }

  std::array<ImageCorner, FacePolygon::kMostEdges + 3> on_image;
  double u0 = 1e300, u1 = -1e300, v0 = 1e300, v1 = -1e300;
  for (int i = 0; i < count; ++i) {
    const double inverse = 1 / clipped[i].z();
    const double u = image_.fx * clipped[i].x() * inverse + image_.cx;
    const double v = image_.fy * clipped[i].y() * inverse + image_.cy;
    on_image[std::size_t(i)] = {u, v};
    u0 = std::min(u0, u), u1 = std::max(u1, u), v0 = std::min(v0, v), v1 = std::max(v1, v);
  }
  const double margin = pixels_per_radian_ * margin_m_ / z0 + kRoundingOfSpans_px;
  polygon.columns = whole(u0 - margin, u1 + margin, image_.width);
  polygon.rows = whole(v0 - margin, v1 + margin, image_.height);
  if (polygon.columns.last < 0 || polygon.rows.last < 0) return false;
  polygon.certain_rows = whole(v0 + margin, v1 - margin, image_.height);
  polygon.nearest_m = z0;
  set_edges({on_image.data(), std::size_t(count)}, margin, polygon);
  set_depth(normal, distance_m, std::min(z1, range_.far_m), polygon);
  return true;
}

void FaceProjector::set_edges(std::span<const ImageCorner> corners, double margin,
                              FacePolygon& polygon) const {
  double mid_u = 0, mid_v = 0;
  for (const ImageCorner& c : corners) {
    mid_u += c.u / double(corners.size());
    mid_v += c.v / double(corners.size());
  }
  polygon.left_edges = polygon.right_edges = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const ImageCorner &p = corners[i], &q = corners[(i + 1) % corners.size()];
    const double du = q.u - p.u, dv = q.v - p.v;
    // `rows` and `certain_rows` stand for edges that run along them.
    if (std::abs(dv) <= 1e-6 * std::abs(du)) continue;
    const double slope = du / dv, offset = p.u - slope * p.v;
    const double slack = margin * (1 + std::abs(slope)) +
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

void FaceProjector::set_depth(const Eigen::Vector3d& normal, double distance_m, double farthest_m,
                              FacePolygon& polygon) const {
  // A point at depth z in the direction (x, y, 1) is on the plane: z · normal · (x, y, 1) =
  // distance.
  constexpr double kFlattest = 0.01;
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
  polygon.least_inverse = float((1 - std::min(rounding, kFlattest)) * (1 - kFloat) / farthest_m);
  polygon.per_u = float(b);
  polygon.per_v = float(c);
}

}  // namespace vantage::detail
