#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "mesh/solids.hpp"
#include "mesh/surface_nets.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage {
namespace {

using Eigen::Vector3d;

// Lengths in this file are in ducks: about 1 from beak to tail.
constexpr double kCell = 0.0205;
constexpr double kFloor = -0.2;
constexpr int kRelaxRounds = 3;

/// An ellipsoid of the duck, turned nose up around y, and with its mirror image at -y if it has
/// one.
struct Part {
  Vector3d centre, radii;
  double nose_up = 0;  // radians
  double blend = 0;    // how far it flows into the parts before it
  bool pair = false;
};

const std::vector<Part>& parts() {
  static const std::vector<Part> kParts = {
      {{0, 0, 0}, {0.42, 0.31, 0.30}, 0, 0, false},                  // body
      {{-0.34, 0, 0.15}, {0.20, 0.14, 0.11}, -0.8, 0.18, false},     // tail
      {{0.18, 0, 0.38}, {0.225, 0.215, 0.22}, 0, 0.10, false},       // head
      {{-0.07, 0.23, 0.05}, {0.24, 0.10, 0.14}, -0.35, 0.05, true},  // wings
      {{0.41, 0, 0.335}, {0.14, 0.115, 0.055}, 0.2, 0.05, false},    // beak
      {{0.36, 0, 0.285}, {0.12, 0.085, 0.06}, -0.1, 0.03, false},    // lower beak
      {{0.31, 0.112, 0.47}, {0.045, 0.045, 0.05}, 0, 0.012, true},   // eyes
  };
  return kParts;
}

/// Exact at the surface, a bound elsewhere: I. Quilez, "Ellipsoid – distance", equation for k0, k1.
double ellipsoid_distance(const Vector3d& p, const Vector3d& radii) {
  const double k0 = p.cwiseQuotient(radii).norm();
  const double k1 = p.cwiseQuotient(radii.cwiseAbs2()).norm();
  return k1 == 0 ? -radii.minCoeff() : k0 * (k0 - 1) / k1;
}

/// The lower one of two distances, rounded off by a parabola where they are closer than `blend`.
double smooth_min(double a, double b, double blend) {
  if (blend == 0) return std::min(a, b);
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - h * h * blend / 4;
}

/// Below 0 inside of the duck, without the floor.
double duck_distance(const Vector3d& p) {
  double distance = std::numeric_limits<double>::infinity();
  for (const Part& part : parts()) {
    Vector3d q = p;
    if (part.pair) q.y() = std::abs(q.y());
    q -= part.centre;
    const double c = std::cos(part.nose_up), s = std::sin(part.nose_up);
    const Vector3d turned(c * q.x() + s * q.z(), q.y(), c * q.z() - s * q.x());
    distance = smooth_min(distance, ellipsoid_distance(turned, part.radii), part.blend);
  }
  return distance;
}

/// Moves a point onto the duck: Newton's steps along the gradient, or along its level part. Three
/// of them are enough from within a cell.
Vector3d onto_duck(Vector3d p, bool level, int rounds) {
  constexpr double kStep = 1e-5;
  for (int round = 0; round < rounds; ++round) {
    Vector3d gradient;
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3d d = kStep * Vector3d::Unit(axis);
      gradient[axis] = (duck_distance(p + d) - duck_distance(p - d)) / (2 * kStep);
    }
    if (level) gradient.z() = 0;
    p -= duck_distance(p) / gradient.squaredNorm() * gradient;
  }
  return p;
}

/// The floor lies just below a layer of the grid's corners: the vertices of the cells under that
/// layer are on the floor, and no others.
raycore::detail::SamplingGrid grid() {
  return {{-0.7, -0.5 * 37 * kCell, kFloor - 1.999 * kCell}, kCell, {68, 38, 45}};
}

bool on_floor(const Vector3d& p) {
  return p.z() < kFloor + 0.0011 * kCell;
}

/// Vertices of the floor that have neighbours above it.
std::vector<bool> find_rim(const raycore::detail::QuadMesh& duck) {
  std::vector<bool> rim(duck.vertices.size(), false);
  for (const auto& quad : duck.quads) {
    const auto floored = [&](std::uint32_t v) { return on_floor(duck.vertices[v]); };
    if (std::all_of(quad.begin(), quad.end(), floored)) continue;
    for (const std::uint32_t v : quad) rim[v] = rim[v] || floored(v);
  }
  return rim;
}

/// Moves every vertex but the rim's to the mean of itself and its neighbours' mean.
void relax(raycore::detail::QuadMesh& duck, const std::vector<bool>& rim) {
  std::vector<Vector3d> sum(duck.vertices.size(), Vector3d::Zero());
  std::vector<int> count(duck.vertices.size(), 0);
  for (const auto& quad : duck.quads) {
    for (std::size_t i = 0; i < 4; ++i) {
      sum[quad[i]] += duck.vertices[quad[(i + 1) % 4]] + duck.vertices[quad[(i + 3) % 4]];
      count[quad[i]] += 2;
    }
  }
  for (std::size_t i = 0; i < duck.vertices.size(); ++i) {
    if (!rim[i]) duck.vertices[i] = 0.5 * (duck.vertices[i] + sum[i] / count[i]);
  }
}

/// Puts every vertex where it belongs: on the floor, on the duck, or on the rim between them.
void project(raycore::detail::QuadMesh& duck, const std::vector<bool>& floored,
             const std::vector<bool>& rim, int rounds) {
  for (std::size_t i = 0; i < duck.vertices.size(); ++i) {
    Vector3d& p = duck.vertices[i];
    if (floored[i]) p.z() = kFloor;
    // What is in the first layer of cells stays there: steps down would lead through the floor.
    if (!floored[i] || rim[i]) p = onto_duck(p, p.z() < kFloor + 1.01 * kCell, rounds);
  }
}

raycore::detail::QuadMesh unit_duck() {
  raycore::detail::QuadMesh duck = raycore::detail::surface_nets(
      [](const Vector3d& p) { return std::max(duck_distance(p), kFloor - p.z()); }, grid());
  const std::vector<bool> rim = find_rim(duck);
  std::vector<bool> floored;
  for (const Vector3d& p : duck.vertices) floored.push_back(on_floor(p));
  for (int round = 0; round < kRelaxRounds; ++round) {
    relax(duck, rim);
    project(duck, floored, rim, 1);
  }
  project(duck, floored, rim, 3);
  return duck;
}

}  // namespace

TriangleMesh duck_solid(double length_m) {
  raycore::detail::check_length(length_m, "length_m");
  raycore::detail::QuadMesh duck = unit_duck();
  Eigen::AlignedBox3d bounds;
  for (const Vector3d& p : duck.vertices) bounds.extend(p);
  const double scale = length_m / bounds.sizes().x();
  std::vector<Eigen::Vector3f> vertices;
  for (const Vector3d& p : duck.vertices) {
    vertices.push_back((scale * (p - bounds.center())).cast<float>());
  }
  TriangleMesh mesh(std::move(vertices), raycore::detail::cut_in_two(duck), "duck");
  if (mesh.dropped_degenerate() > 0) {
    throw bad_input("length_m", "the duck is too small for floats to keep its faces apart");
  }
  return mesh;
}

}  // namespace vantage
