#include "scoring/voxel/surface_samples.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "vantage/raycore/box_projector.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::detail {
namespace {

constexpr double kAreaPerPoint = 2e-6;
constexpr double kMostPoints = 1 << 17;

using Polygon = std::vector<Eigen::Vector3d>;

/// The part of a convex polygon where sign · (p[axis] - border) <= 0 (I. Sutherland and
/// G. Hodgman, 1974).
Polygon cut(const Polygon& polygon, int axis, double border, double sign) {
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double over_a = sign * (a[axis] - border), over_b = sign * (b[axis] - border);
    if (over_a <= 0) part.push_back(a);
    if ((over_a < 0 && over_b > 0) || (over_a > 0 && over_b < 0)) {
      part.push_back(a + (b - a) * (over_a / (over_a - over_b)));
    }
  }
  return part;
}

struct Patch {
  Eigen::Vector3d a, b, c, normal;
  double area;
};

/// A triangle's part inside a box, as triangles.
void add_patches(const Polygon& triangle, const Box& inside, std::vector<Patch>& patches) {
  const Eigen::Vector3d across = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
  if (!(across.norm() > 0)) return;
  Polygon part = triangle;
  for (int axis = 0; axis < 3; ++axis) {
    part = cut(part, axis, inside.max()[axis], 1);
    part = cut(part, axis, inside.min()[axis], -1);
  }
  for (std::size_t i = 2; i < part.size(); ++i) {
    const double area = 0.5 * (part[i - 1] - part[0]).cross(part[i] - part[0]).norm();
    patches.push_back({part[0], part[i - 1], part[i], across.normalized(), area});
  }
}

std::vector<Patch> patches_inside(const WorldModel& world, const Box& inside) {
  std::vector<Patch> patches;
  for (const auto* objects : {&world.objects, &world.static_structures}) {
    for (const KnownObject& object : *objects) {
      const TriangleMesh mesh = object.mesh->transformed(object.T_world_object);
      for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
        const Polygon corners = {mesh.corner(t, 0).cast<double>(), mesh.corner(t, 1).cast<double>(),
                                 mesh.corner(t, 2).cast<double>()};
        add_patches(corners, inside, patches);
      }
    }
  }
  return patches;
}

/// Sample i of an area: R2, the two-dimensional sequence of the plastic number (M. Roberts, "The
/// unreasonable effectiveness of quasirandom sequences", 2018), folded into the triangle.
Eigen::Vector3d sample(const Patch& patch, std::size_t i) {
  double s = std::fmod(0.5 + double(i) * 0.7548776662466927, 1.0);
  double t = std::fmod(0.5 + double(i) * 0.5698402909980532, 1.0);
  if (s + t > 1) s = 1 - s, t = 1 - t;
  return patch.a + s * (patch.b - patch.a) + t * (patch.c - patch.a);
}

}  // namespace

SurfaceSamples surface_samples(const WorldModel& world, const Box& inside) {
  const std::vector<Patch> patches = patches_inside(world, inside);
  double area = 0;
  for (const Patch& patch : patches) area += patch.area;
  SurfaceSamples samples{{}, std::max(kAreaPerPoint, area / kMostPoints)};
  const double farthest =
      std::max(inside.min().cwiseAbs().maxCoeff(), inside.max().cwiseAbs().maxCoeff());
  // As little as rays can tell: a face seen edge-on from behind would show a strip of its points
  // that is many times wider than the offset.
  const double off = kRoundingOfRays * std::max(1.0, farthest);
  // A point wherever the area so far passes the middle of another point's share.
  double so_far = 0;
  std::size_t i = 0;
  for (const Patch& patch : patches) {
    so_far += patch.area;
    for (; (double(i) + 0.5) * samples.area_per_point_m2 < so_far; ++i) {
      samples.points.push_back((sample(patch, i) + off * patch.normal).cast<float>());
    }
  }
  return samples;
}

}  // namespace vantage::detail
