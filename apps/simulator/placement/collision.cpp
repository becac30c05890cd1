#include "simulator/placement/collision.hpp"

#include <algorithm>
#include <utility>

#include "simulator/placement/mass_properties.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage {
namespace {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

AlignedBox3d widened(const AlignedBox3d& box, double by_m) {
  return {box.min() - Vector3d::Constant(by_m), box.max() + Vector3d::Constant(by_m)};
}

// Whether an edge goes through a face of the other body.
bool edges_cross(const std::vector<EdgeEnds>& edges, const Pose& T_other_edges,
                 const CollisionShape& other) {
  Points from, to;
  for (const auto& [begin, end] : edges) {
    const Vector3d a = T_other_edges * begin, b = T_other_edges * end;
    if (!AlignedBox3d(a.cwiseMin(b), a.cwiseMax(b)).intersects(other.bounds())) continue;
    const Eigen::Vector3f ray_a = a.cast<float>(), ray_b = b.cast<float>();
    if (ray_a != ray_b) from.push_back(ray_a), to.push_back(ray_b);
  }
  std::vector<std::uint8_t> hit(from.size());
  other.rays().occluded(from, to, hit);
  return std::find(hit.begin(), hit.end(), 1) != hit.end();
}

// Whether a point lies inside the other body: what it sees first, looking up, is a face's back.
bool points_inside(const std::vector<Vector3d>& points, const CollisionShape& other) {
  Points from, up;
  for (const Vector3d& point : points) {
    if (!other.bounds().contains(point)) continue;
    from.push_back(point.cast<float>()), up.push_back(Eigen::Vector3f::UnitZ());
  }
  Hits hits;
  other.rays().closest_hits(from, up, hits);
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits.hit(i) && hits.normal.z[i] > 0) return true;
  }
  return false;
}

struct BoundedTriangle {
  TriangleCorners corners;
  AlignedBox3d bounds;
};

// The triangles that reach into the region, mapped, in the order of where they begin along x.
std::vector<BoundedTriangle> triangles_in(const AlignedBox3d& region,
                                          const std::vector<TriangleCorners>& triangles,
                                          const Pose& T_target_mesh) {
  std::vector<BoundedTriangle> found;
  for (const TriangleCorners& triangle : triangles) {
    BoundedTriangle mapped;
    for (std::size_t i = 0; i < 3; ++i) {
      mapped.corners[i] = T_target_mesh * triangle[i];
      mapped.bounds.extend(mapped.corners[i]);
    }
    if (mapped.bounds.intersects(region)) found.push_back(mapped);
  }
  std::sort(found.begin(), found.end(), [](const BoundedTriangle& a, const BoundedTriangle& b) {
    return a.bounds.min().x() < b.bounds.min().x();
  });
  return found;
}

// Every pair whose boxes come closer than the gap; of those along x, whose begin lies between what
// the widest one can reach back from and the end of the first triangle.
bool triangles_closer(double gap_m, const std::vector<BoundedTriangle>& some,
                      const std::vector<BoundedTriangle>& others) {
  double widest = 0;
  for (const BoundedTriangle& other : others) {
    widest = std::max(widest, other.bounds.sizes().x());
  }
  for (const BoundedTriangle& one : some) {
    const AlignedBox3d near = widened(one.bounds, gap_m);
    auto other =
        std::lower_bound(others.begin(), others.end(), near.min().x() - widest,
                         [](const BoundedTriangle& t, double x) { return t.bounds.min().x() < x; });
    for (; other != others.end() && other->bounds.min().x() <= near.max().x(); ++other) {
      if (near.intersects(other->bounds) &&
          distance_of_uncrossed(one.corners, other->corners) < gap_m) {
        return true;
      }
    }
  }
  return false;
}

std::vector<Vector3d> mapped(const std::vector<Vector3d>& points, const Pose& T_target_source) {
  std::vector<Vector3d> result;
  result.reserve(points.size());
  for (const Vector3d& point : points) result.push_back(T_target_source * point);
  return result;
}

AlignedBox3d bounds_of(const std::vector<Vector3d>& points) {
  AlignedBox3d bounds;
  for (const Vector3d& point : points) bounds.extend(point);
  return bounds;
}

std::vector<EdgeEnds> edge_ends(const TriangleMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ends;
  for (const auto& [a, b, c] : mesh.triangles()) {
    ends.insert(ends.end(), {std::minmax(a, b), std::minmax(b, c), std::minmax(c, a)});
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<EdgeEnds> edges;
  for (const auto& [a, b] : ends) {
    edges.push_back({mesh.vertices()[a].cast<double>(), mesh.vertices()[b].cast<double>()});
  }
  return edges;
}

bool far_apart(double gap_m, const CollisionShape& a, const Pose& T_world_a,
               const CollisionShape& b, const Pose& T_world_b) {
  const double reach = (a.bounds().diagonal().norm() + b.bounds().diagonal().norm()) / 2 + gap_m;
  return (T_world_a * a.bounds().center() - T_world_b * b.bounds().center()).norm() > reach;
}

}  // namespace

CollisionShape::CollisionShape(const TriangleMesh& mesh)
    : points_(surface_points(mesh)), bounds_(bounds_of(points_)), edges_(edge_ends(mesh)) {
  for (const auto& [a, b, c] : mesh.triangles()) {
    triangles_.push_back({mesh.vertices()[a].cast<double>(), mesh.vertices()[b].cast<double>(),
                          mesh.vertices()[c].cast<double>()});
  }
  SceneBuilder builder;
  builder.add_mesh(mesh);
  rays_ = builder.build();
}

bool closer_than(double gap_m, const CollisionShape& a, const Pose& T_world_a,
                 const CollisionShape& b, const Pose& T_world_b) {
  if (a.points().empty() || b.points().empty()) return false;
  if (far_apart(gap_m, a, T_world_a, b, T_world_b)) return false;
  const Pose T_a_b = T_world_a.inverse() * T_world_b, T_b_a = T_a_b.inverse();
  const std::vector<Vector3d> a_in_b = mapped(a.points(), T_b_a),
                              b_in_a = mapped(b.points(), T_a_b);
  const AlignedBox3d region_in_b = widened(bounds_of(a_in_b), gap_m);
  if (!region_in_b.intersects(b.bounds())) return false;
  if (!widened(bounds_of(b_in_a), gap_m).intersects(a.bounds())) return false;

  if (edges_cross(a.edges(), T_b_a, b) || edges_cross(b.edges(), T_a_b, a)) return true;
  if (points_inside(a_in_b, b) || points_inside(b_in_a, a)) return true;
  return triangles_closer(gap_m, triangles_in(widened(b.bounds(), gap_m), a.triangles(), T_b_a),
                          triangles_in(region_in_b, b.triangles(), Pose()));
}

}  // namespace vantage
