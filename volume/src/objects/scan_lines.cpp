#include "objects/scan_lines.hpp"

#include <algorithm>
#include <array>

#include "grid/grid_frame.hpp"

namespace vantage::volume::detail {
namespace {

__extension__ using Wide = __float128;  // products of three floats' differences fit

struct Point2 {
  float x, y;
};

bool before(const Point2& a, const Point2& b) {
  return a.x < b.x || (a.x == b.x && a.y < b.y);
}

/// On which side of the line from `a` to `b` a point lies: +1 left, -1 right. A point on the line
/// counts as moved by (ε, ε²), so that it never is (Edelsbrunner and Mücke, "Simulation of
/// simplicity", 1990).
int side(const Point2& a, const Point2& b, const Point2& p) {
  const double left = (double(b.x) - a.x) * (double(p.y) - a.y);
  const double right = (double(b.y) - a.y) * (double(p.x) - a.x);
  const double difference = left - right;
  // Each product is off by less than three roundings of 2⁻⁵³.
  if (std::abs(difference) > 1e-15 * (std::abs(left) + std::abs(right))) {
    return difference > 0 ? 1 : -1;
  }
  const Wide exact = (Wide(b.x) - a.x) * (Wide(p.y) - a.y) - (Wide(b.y) - a.y) * (Wide(p.x) - a.x);
  if (exact != 0) return exact > 0 ? 1 : -1;
  if (a.y != b.y) return a.y > b.y ? 1 : -1;
  return b.x > a.x ? 1 : -1;
}

/// The same for an edge in either direction: two triangles must hear the same of a shared edge.
int side_of_edge(const Point2& a, const Point2& b, const Point2& p) {
  return before(a, b) ? side(a, b, p) : -side(b, a, p);
}

struct Projected {
  std::array<Point2, 3> corners;

  explicit Projected(const std::array<Eigen::Vector3f, 3>& c)
      : corners{{{c[0].x(), c[0].y()}, {c[1].x(), c[1].y()}, {c[2].x(), c[2].y()}}} {}

  /// +1 inside a counter-clockwise triangle, -1 inside a clockwise one, 0 outside.
  int winding(const Point2& p) const {
    int sides = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      const Point2 &a = corners[c], &b = corners[(c + 1) % 3];
      if (a.x == b.x && a.y == b.y) return 0;  // seen edge on
      sides += side_of_edge(a, b, p);
    }
    return sides == 3 ? 1 : sides == -3 ? -1 : 0;
  }
};

struct IndexRange {
  int first, last;
};

IndexRange columns(float low, float high, int first, int last, double voxel_size_m) {
  // One more to either side: the test itself is exact.
  return {std::max(first_centre_above(double(low), voxel_size_m) - 1, first),
          std::min(first_centre_above(double(high), voxel_size_m) + 1, last)};
}

double height_at(const std::array<Eigen::Vector3f, 3>& c, const Point2& p) {
  const Eigen::Vector3d a = c[0].cast<double>();
  const Eigen::Vector3d u = c[1].cast<double>() - a, v = c[2].cast<double>() - a;
  const double det = u.x() * v.y() - u.y() * v.x();
  const double x = p.x - a.x(), y = p.y - a.y();
  const double z =
      a.z() + ((x * v.y() - y * v.x()) * u.z() + (u.x() * y - u.y() * x) * v.z()) / det;
  // A triangle that is nearly edge on: rounding must not lead out of it.
  const auto [low, high] = std::minmax({a.z(), double(c[1].z()), double(c[2].z())});
  return det != 0 ? std::clamp(z, low, high) : low;
}

}  // namespace

std::vector<Crossing> scan_line_crossings(const PlacedTriangles& mesh, const CellRange& voxels,
                                          double voxel_size_m) {
  std::vector<Crossing> crossings;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array<Eigen::Vector3f, 3> c = {mesh.corner(t, 0), mesh.corner(t, 1),
                                              mesh.corner(t, 2)};
    const auto [x0, x1] = std::minmax({c[0].x(), c[1].x(), c[2].x()});
    const auto [y0, y1] = std::minmax({c[0].y(), c[1].y(), c[2].y()});
    const IndexRange is = columns(x0, x1, voxels.first.x(), voxels.last.x(), voxel_size_m);
    const IndexRange js = columns(y0, y1, voxels.first.y(), voxels.last.y(), voxel_size_m);
    const Projected triangle(c);
    for (int i = is.first; i < is.last; ++i) {
      for (int j = js.first; j < js.last; ++j) {
        const Point2 p{centre_coordinate(i, voxel_size_m), centre_coordinate(j, voxel_size_m)};
        const int winding = triangle.winding(p);
        // Counter-clockwise from above looks up: a line upwards leaves there.
        if (winding != 0) crossings.push_back({i, j, -winding, height_at(c, p)});
      }
    }
  }
  return crossings;
}

}  // namespace vantage::volume::detail
