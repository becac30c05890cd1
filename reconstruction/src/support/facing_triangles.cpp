#include "support/facing_triangles.hpp"

#include <algorithm>
#include <cmath>

namespace vantage::reconstruction::detail {
namespace {

constexpr double kLeastOpposed = 0.05;  ///< of the cosine of two faces that face each other
constexpr double kSameSpot_m = 1e-7;

/// At most six corners: a triangle cut by three lines.
struct SmallPolygon {
  std::array<Eigen::Vector2d, 8> corners;
  std::size_t size = 0;
  void add(const Eigen::Vector2d& p) { corners[size++] = p; }
};

double cross_of(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// What is left of the line from a to b (Sutherland and Hodgman, 1974).
SmallPolygon cut(const SmallPolygon& polygon, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  SmallPolygon result;
  const Eigen::Vector2d way = (b - a).normalized();
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Eigen::Vector2d& p = polygon.corners[i];
    const Eigen::Vector2d& q = polygon.corners[(i + 1) % polygon.size];
    const double left_p = cross_of(way, p - a), left_q = cross_of(way, q - a);
    if (left_p >= -kSameSpot_m) result.add(p);
    if ((left_p >= -kSameSpot_m) != (left_q >= -kSameSpot_m)) {
      result.add(p + (q - p) * (left_p / (left_p - left_q)));
    }
    if (result.size + 2 > result.corners.size()) break;
  }
  return result;
}

/// Of a long polygon how wide it is, of others about half of that.
double width_of(const SmallPolygon& polygon) {
  double twice_area = 0, around = 0;
  for (std::size_t i = 0; i < polygon.size; ++i) {
    const Eigen::Vector2d& p = polygon.corners[i];
    const Eigen::Vector2d& q = polygon.corners[(i + 1) % polygon.size];
    twice_area += cross_of(p, q);
    around += (q - p).norm();
  }
  return around > 0 ? std::abs(twice_area) / around : 0;
}

/// Two triangles seen along the middle of their normals.
class FacingPair {
 public:
  FacingPair(const FacingTriangle& upper, const FacingTriangle& lower)
      : upper_(upper), lower_(lower), middle_((lower.normal - upper.normal).normalized()) {
    u_ = middle_.unitOrthogonal();
    v_ = middle_.cross(u_);
    for (int i = 0; i < 3; ++i) {
      upper_uv_[i] = flat(upper.corners[i]);
      lower_uv_[i] = flat(lower.corners[i]);
    }
  }

  SmallPolygon overlap() const {
    SmallPolygon polygon;
    for (const Eigen::Vector2d& corner : upper_uv_) polygon.add(corner);
    for (int i = 0; i < 3 && polygon.size > 0; ++i) {
      polygon = cut(polygon, lower_uv_[i], lower_uv_[(i + 1) % 3]);
    }
    return polygon;
  }

  ContactPoint contact(const Eigen::Vector2d& at, bool is_flat) const {
    const double high = height(upper_, at), low = height(lower_, at);
    ContactPoint result;
    result.point = lower_.corners[0] + u_ * at.x() + v_ * at.y() + middle_ * 0.5 * (high + low);
    result.normal = is_flat ? lower_.normal : normal_at(at);
    result.gap_m = (high - low) * middle_.dot(result.normal);
    result.is_flat = is_flat;
    result.upper_normal = upper_.normal;
    return result;
  }

 private:
  Eigen::Vector2d flat(const Eigen::Vector3d& p) const {
    const Eigen::Vector3d from = p - lower_.corners[0];
    return {u_.dot(from), v_.dot(from)};
  }

  /// Of the triangle's plane there, along the middle of the normals.
  double height(const FacingTriangle& triangle, const Eigen::Vector2d& at) const {
    const Eigen::Vector3d p = lower_.corners[0] + u_ * at.x() + v_ * at.y();
    return triangle.normal.dot(triangle.corners[0] - p) / triangle.normal.dot(middle_);
  }

  /// The nearest edge of a triangle, or nothing where two are: at a corner.
  static std::optional<int> edge_at(const std::array<Eigen::Vector2d, 3>& corners,
                                    const Eigen::Vector2d& at, bool& is_inside) {
    int edge = 0, count = 0;
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector2d way = (corners[(i + 1) % 3] - corners[i]).normalized();
      if (std::abs(cross_of(way, at - corners[i])) < 10 * kSameSpot_m) edge = i, ++count;
    }
    is_inside = count == 0;
    return count == 1 ? std::optional<int>(edge) : std::nullopt;
  }

  /// A corner pushes along the normal of the face that it meets, two edges across both.
  Eigen::Vector3d normal_at(const Eigen::Vector2d& at) const {
    bool in_upper = false, in_lower = false;
    const auto upper_edge = edge_at(upper_uv_, at, in_upper);
    const auto lower_edge = edge_at(lower_uv_, at, in_lower);
    if (in_upper) return -upper_.normal;
    if (in_lower || !upper_edge || !lower_edge) return lower_.normal;
    const auto along = [](const FacingTriangle& triangle, int edge) -> Eigen::Vector3d {
      return triangle.corners[(edge + 1) % 3] - triangle.corners[edge];
    };
    const Eigen::Vector3d across = along(upper_, *upper_edge).cross(along(lower_, *lower_edge));
    const double length = across.norm();
    if (!(length > 1e-3 * along(upper_, *upper_edge).norm() * along(lower_, *lower_edge).norm())) {
      return middle_;
    }
    return across * ((across.dot(middle_) < 0 ? -1 : 1) / length);
  }

  const FacingTriangle& upper_;
  const FacingTriangle& lower_;
  Eigen::Vector3d middle_, u_, v_;
  std::array<Eigen::Vector2d, 3> upper_uv_, lower_uv_;
};

}  // namespace

void add_contacts(const FacingTriangle& upper, const FacingTriangle& lower, const GapLimits& limits,
                  std::vector<ContactPoint>& points) {
  const double opposed = -upper.normal.dot(lower.normal);
  if (opposed < kLeastOpposed) return;
  const FacingPair pair(upper, lower);
  const SmallPolygon overlap = pair.overlap();
  // Faces that meet at an edge only, as the sides of a body and of one on top of it, do not touch;
  // and bodies that overlap by more than the faces do, and than the poses explain, are in touch in
  // another direction.
  const double width = width_of(overlap);
  if (width < 10 * kSameSpot_m) return;
  for (std::size_t i = 0; i < overlap.size; ++i) {
    const ContactPoint contact = pair.contact(overlap.corners[i], opposed >= limits.flat_cosine);
    const double deepest = std::min(limits.deepest_m, std::max(width, limits.widest_m));
    if (contact.gap_m >= -deepest && contact.gap_m <= limits.widest_m) {
      points.push_back(contact);
    }
  }
}

}  // namespace vantage::reconstruction::detail
