#include "scoring/voxel/light_scorer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "vantage/planner/advanced/light_scorer.hpp"
#include "vantage/raycore/detail/box_projector.hpp"
#include "vantage/raycore/triangle_mesh.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage::planner::detail {
namespace {

constexpr double kAreaPerPoint = 2e-6;
constexpr double kMaxPoints = 1 << 17;

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
  SurfaceSamples samples{{}, std::max(kAreaPerPoint, area / kMaxPoints)};
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

}  // namespace vantage::planner::detail

namespace vantage {
namespace {

/// The samples that no camera sees.
VisiblePoints in_the_dark(const Points& samples, const WorldModel& world) {
  const std::shared_ptr<const Scene> known = known_scene(world);
  const VisiblePoints all(samples, known);
  std::vector<std::uint8_t> lit(samples.size());
  for (const DepthCamera& lamp : world.cameras) {
    const std::vector<std::uint8_t> seen = all.visible(lamp.camera);
    for (std::size_t i = 0; i < lit.size(); ++i) lit[i] |= seen[i];
  }
  Points dark;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    if (lit[i] == 0) dark.push_back(samples[i]);
  }
  return {std::move(dark), known};
}

}  // namespace

LightScorer::LightScorer(const PlanningScene& scene, const WorldModel& world)
    : LightScorer(planner::detail::surface_samples(world, scene.grid().geometry().box()), world) {}

// What faces away needs no test of its own: the surface itself lies between, as it does for a lamp.
LightScorer::LightScorer(const planner::detail::SurfaceSamples& samples, const WorldModel& world)
    : area_per_point_m2_(samples.area_per_point_m2), dark_(in_the_dark(samples.points, world)) {}

Score LightScorer::upper_bound(const PinholeCamera& view) const {
  return dark_.upper_bound(view);
}

void LightScorer::score(std::span<const PinholeCamera> views, std::span<const Score> needed,
                        std::span<ScoreBound> results, const StopToken& stop) const {
  dark_.count(views, needed, results, stop);
}

std::vector<ScoreTerm> LightScorer::terms(const PinholeCamera& view) const {
  const double lit = double(score(view).score) * area_per_point_m2_;
  const double in_view = double(dark_.count_in_view(view)) * area_per_point_m2_;
  const double dark = double(dark_.size()) * area_per_point_m2_;
  return {{"dark surface out of view", dark - in_view, "m²"},
          {"dark surface in view", in_view, "m²"},
          {"dark surface hidden or facing away", in_view - lit, "m²"},
          {"dark surface lit", lit, "m²"}};
}

}  // namespace vantage
