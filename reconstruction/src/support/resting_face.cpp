#include "support/resting_face.hpp"

#include <algorithm>
#include <cmath>

namespace vantage::reconstruction::detail {
namespace {

constexpr double kHorizontal = 0.95;  ///< z of the normal
constexpr double kSameFace = 0.9999;  ///< cosine of normals
constexpr double kWide = 0.15;        ///< of the body's width: a face of it, not a part of a round
constexpr double kBulge_m = 0.0003;   ///< of a body beyond the face that it lies on
constexpr double kEnd = 0.25;         ///< of the face's length

/// Those that lie on the face of the upper body which is the nearest to being flat.
std::vector<ContactPoint> on_flattest_face(const ContactPatch& patch) {
  const ContactPoint* flattest = nullptr;
  const auto opposed = [](const ContactPoint& p) { return -p.upper_normal.dot(p.normal); };
  for (const ContactPoint& point : patch.points) {
    if (!point.is_flat || point.normal.z() < kHorizontal) continue;
    if (flattest == nullptr || opposed(point) > opposed(*flattest)) flattest = &point;
  }
  std::vector<ContactPoint> result;
  if (flattest == nullptr) return result;
  for (const ContactPoint& point : patch.points) {
    const bool same = point.is_flat && point.normal.dot(flattest->normal) > kSameFace &&
                      point.upper_normal.dot(flattest->upper_normal) > kSameFace;
    if (same) result.push_back(point);
  }
  return result;
}

struct Extent {
  double low = 0, high = 0;
  double length() const { return high - low; }
};

template <class Points, class Place>
Extent extent_of(const Points& points, const Eigen::Vector3d& axis, Place place) {
  Extent extent{HUGE_VAL, -HUGE_VAL};
  for (const auto& point : points) {
    const double at = axis.dot(place(point));
    extent = {std::min(extent.low, at), std::max(extent.high, at)};
  }
  return extent;
}

const Eigen::Vector3d& place_of(const ContactPoint& contact) {
  return contact.point;
}

/// The middle of the points that lie between two values along an axis.
RestingDistance middle_of(const std::vector<ContactPoint>& points, const Eigen::Vector3d& axis,
                          const Extent& part) {
  RestingDistance middle{Eigen::Vector3d::Zero(), points.front().normal, 0};
  int count = 0;
  for (const ContactPoint& point : points) {
    const double at = axis.dot(point.point);
    if (at < part.low - 1e-9 || at > part.high + 1e-9) continue;
    middle.point += point.point;
    middle.gap_m += point.gap_m;
    ++count;
  }
  middle.point /= count;
  middle.gap_m /= count;
  return middle;
}

/// The directions in which the points extend most and least, across the normal.
std::array<Eigen::Vector3d, 2> axes_of(const std::vector<ContactPoint>& points) {
  const Eigen::Vector3d u = points.front().normal.unitOrthogonal();
  const Eigen::Vector3d v = points.front().normal.cross(u);
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const ContactPoint& p : points) mean += Eigen::Vector2d(u.dot(p.point), v.dot(p.point));
  mean /= double(points.size());
  double uu = 0, uv = 0, vv = 0;
  for (const ContactPoint& p : points) {
    const double x = u.dot(p.point) - mean.x(), y = v.dot(p.point) - mean.y();
    uu += x * x, uv += x * y, vv += y * y;
  }
  const double angle = 0.5 * std::atan2(2 * uv, uu - vv);
  const Eigen::Vector3d longest = std::cos(angle) * u + std::sin(angle) * v;
  return {longest, points.front().normal.cross(longest)};
}

/// On the floor nothing of the body may be lower than the face that it lies on.
bool bulges(const SupportBody& body, const ContactPoint& contact) {
  return std::ranges::any_of(body.vertices, [&](const Eigen::Vector3d& vertex) {
    return contact.upper_normal.dot(vertex - contact.point) > kBulge_m;
  });
}

}  // namespace

std::vector<RestingDistance> resting_distances(std::span<const SupportBody> bodies,
                                               const ContactPatch& patch) {
  const std::vector<ContactPoint> points = on_flattest_face(patch);
  const SupportBody& body = bodies[patch.upper];
  if (points.empty()) return {};
  const bool on_floor = patch.lower == bodies.size();
  if (on_floor && bulges(body, points.front())) return {};
  const auto itself = [](const Eigen::Vector3d& p) -> const Eigen::Vector3d& { return p; };
  std::vector<RestingDistance> distances;
  for (const Eigen::Vector3d& axis : axes_of(points)) {
    const Extent face = extent_of(points, axis, place_of);
    const Extent whole = extent_of(body.vertices, axis, itself);
    if (face.length() < kWide * whole.length()) continue;
    const double end = kEnd * face.length();
    distances.push_back(middle_of(points, axis, {face.low, face.low + end}));
    distances.push_back(middle_of(points, axis, {face.high - end, face.high}));
  }
  if (distances.empty()) {
    const Extent all = extent_of(points, points.front().normal, place_of);
    distances.push_back(middle_of(points, points.front().normal, all));
  }
  return distances;
}

}  // namespace vantage::reconstruction::detail
