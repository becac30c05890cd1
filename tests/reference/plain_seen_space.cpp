#include "reference/plain_seen_space.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "support/non_finite.hpp"

namespace vantage::test {
namespace {

constexpr double kSame = 2e-5;  // what is that close in t may change places in float

/// The plane through three points, with `inside` on its positive side.
Eigen::Vector4d plane(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                      const Eigen::Vector3d& inside) {
  Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  if (normal.dot(inside - a) < 0) normal = -normal;
  return {normal.x(), normal.y(), normal.z(), -normal.dot(a)};
}

double distance(const Eigen::Vector4d& plane, const Eigen::Vector3d& point) {
  return plane.head<3>().dot(point) + plane.w();
}

/// Narrows enter … leave to the positive side of a plane.
/// @returns whether the ray leaves there.
bool clip(const Eigen::Vector4d& plane, const Eigen::Vector3d& origin,
          const Eigen::Vector3d& direction, double& enter, double& leave) {
  const double height = distance(plane, origin), slope = plane.head<3>().dot(direction);
  if (slope == 0) {
    if (height < 0) leave = -kInfinity;
    return false;
  }
  const double t = -height / slope;
  if (slope > 0) {
    enter = std::max(enter, t);
    return false;
  }
  if (t >= leave) return false;
  leave = t;
  return true;
}

}  // namespace

PlainSeenSpace::PlainSeenSpace(std::span<const VisibilityMesh> lattices, const Box& box)
    : box_(box) {
  for (std::uint32_t k = 0; k < lattices.size(); ++k) {
    const VisibilityMesh& lattice = lattices[k];
    const auto depth = [&](std::size_t i, std::size_t j) {
      return double(lattice.depth[j * lattice.columns.size() + i]);
    };
    const auto vertex = [&](std::size_t i, std::size_t j) {
      return lattice.camera.unproject(double(lattice.columns[i]), double(lattice.rows[j]),
                                      depth(i, j));
    };
    for (std::size_t j = 0; j + 1 < lattice.rows.size(); ++j) {
      for (std::size_t i = 0; i + 1 < lattice.columns.size(); ++i) {
        if (std::isnan(depth(i, j) + depth(i + 1, j) + depth(i, j + 1) + depth(i + 1, j + 1))) {
          continue;
        }
        const Eigen::Vector3d right = vertex(i + 1, j), left = vertex(i, j + 1);
        add_triangle(k, vertex(i, j), right, left, lattice.camera.centre());
        add_triangle(k, vertex(i + 1, j + 1), right, left, lattice.camera.centre());
      }
    }
  }
}

void PlainSeenSpace::add_triangle(std::uint32_t lattice, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                                  const Eigen::Vector3d& apex) {
  tetrahedra_.push_back(
      {lattice,
       {plane(a, b, c, apex), plane(a, b, apex, c), plane(b, c, apex, a), plane(c, a, apex, b)},
       apex});
}

std::vector<PlainSeenSpace::Interval> PlainSeenSpace::intervals(
    const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
  std::vector<Interval> result;
  for (const Tetrahedron& tetrahedron : tetrahedra_) {
    double enter = 0, leave = kInfinity;
    bool through_surface = false;
    for (int face = 0; face < 4; ++face) {
      if (clip(tetrahedron.planes[std::size_t(face)], origin, direction, enter, leave)) {
        through_surface = face == 0;
      }
    }
    if (!(enter < leave)) continue;
    const Eigen::Vector3d to_camera = tetrahedron.apex - (origin + leave * direction);
    const double facing = tetrahedron.planes[0].head<3>().dot(to_camera.normalized());
    result.push_back({enter, leave, tetrahedron.lattice, through_surface ? facing : 0});
  }
  std::sort(result.begin(), result.end(),
            [](const Interval& a, const Interval& b) { return a.enter < b.enter; });
  return result;
}

PlainUnseen PlainSeenSpace::first_unseen(const Eigen::Vector3d& origin,
                                         const Eigen::Vector3d& direction, double t_far,
                                         double thinnest) const {
  double t = 0, t_end = t_far;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d unit = Eigen::Vector3d::Unit(axis);
    clip({unit.x(), unit.y(), unit.z(), -box_.min()[axis]}, origin, direction, t, t_end);
    clip({-unit.x(), -unit.y(), -unit.z(), box_.max()[axis]}, origin, direction, t, t_end);
  }
  const double start = t;
  const std::vector<Interval> seen = intervals(origin, direction);
  for (const Interval& interval : seen) {
    if (interval.enter > t + thinnest) break;
    t = std::max(t, interval.leave);
  }
  if (t + thinnest >= t_end) return {kInfinity, false, {}};
  PlainUnseen result{t, t - start <= kSame, {}};
  for (const Interval& interval : seen) {
    if (std::abs(interval.leave - t) <= kSame) {
      result.sources.push_back({interval.lattice, interval.facing});
    }
  }
  return result;
}

bool PlainSeenSpace::sees(std::uint32_t lattice, const Eigen::Vector3d& point) const {
  return std::any_of(tetrahedra_.begin(), tetrahedra_.end(), [&](const Tetrahedron& tetrahedron) {
    return tetrahedron.lattice == lattice &&
           std::all_of(tetrahedron.planes.begin(), tetrahedron.planes.end(),
                       [&](const Eigen::Vector4d& p) { return distance(p, point) >= 0; });
  });
}

}  // namespace vantage::test
