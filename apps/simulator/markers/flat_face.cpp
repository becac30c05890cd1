#include "simulator/markers/flat_face.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace vantage::simulator::detail {
namespace {

// Corners are stored as floats, and long thin triangles know little of their normals.
constexpr double kFlatDistance = 1e-5;  // metres
constexpr double kFlatCosine = 1 - 1e-6;

std::array<Eigen::Vector3d, 3> corners_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  return {mesh.corner(triangle, 0).cast<double>(), mesh.corner(triangle, 1).cast<double>(),
          mesh.corner(triangle, 2).cast<double>()};
}

Eigen::Vector3d cross_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto [a, b, c] = corners_of(mesh, triangle);
  return (b - a).cross(c - a);
}

/// A number for each vertex, the same for vertices at the same place; and how many there are.
std::uint32_t number_places(const std::vector<Eigen::Vector3f>& vertices,
                            std::vector<std::uint32_t>& place_of_vertex) {
  const auto key = [&](std::uint32_t v) {
    return std::array{vertices[v].x(), vertices[v].y(), vertices[v].z()};
  };
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  place_of_vertex.resize(vertices.size());
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i > 0 && key(order[i]) != key(order[i - 1])) ++count;
    place_of_vertex[order[i]] = count;
  }
  return order.empty() ? 0 : count + 1;
}

double distance_to_segment(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                           const Eigen::Vector3d& point) {
  const Eigen::Vector3d ab = b - a;
  const double t = std::clamp((point - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
  return (point - a - t * ab).norm();
}

}  // namespace

FaceFinder::FaceFinder(const TriangleMesh& mesh) : mesh_(mesh) {
  const std::uint32_t places = number_places(mesh.vertices(), place_of_vertex_);
  first_.assign(places + 1, 0);
  for (const Triangle& triangle : mesh.triangles()) {
    for (const std::uint32_t v : triangle) ++first_[place_of_vertex_[v] + 1];
  }
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  triangles_.resize(3 * mesh.triangles().size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) {
    for (const std::uint32_t v : mesh.triangles()[t]) triangles_[next[place_of_vertex_[v]]++] = t;
  }
}

std::span<const std::uint32_t> FaceFinder::around(std::uint32_t place) const {
  return std::span(triangles_).subspan(first_[place], first_[place + 1] - first_[place]);
}

std::vector<std::uint32_t> FaceFinder::flat_face(std::uint32_t seed) const {
  const Eigen::Vector3d normal = normal_of(mesh_, seed);
  const Eigen::Vector3d origin = mesh_.corner(seed, 0).cast<double>();
  const auto in_plane = [&](std::uint32_t triangle) {
    for (const Eigen::Vector3d& p : corners_of(mesh_, triangle)) {
      if (std::abs(normal.dot(p - origin)) > kFlatDistance) return false;
    }
    return normal.dot(normal_of(mesh_, triangle)) >= kFlatCosine;
  };
  std::vector<bool> looked_at(mesh_.triangles().size(), false);
  std::vector<std::uint32_t> face = {seed};
  looked_at[seed] = true;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Triangle triangle = mesh_.triangles()[face[i]];
    for (const std::uint32_t vertex : triangle) {
      for (const std::uint32_t neighbour : around(place_of_vertex_[vertex])) {
        if (looked_at[neighbour]) continue;
        looked_at[neighbour] = true;
        if (in_plane(neighbour)) face.push_back(neighbour);
      }
    }
  }
  std::sort(face.begin(), face.end());
  return face;
}

Eigen::Vector3d normal_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  return cross_of(mesh, triangle).stableNormalized();
}

double area_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  return cross_of(mesh, triangle).norm() / 2;
}

double distance_to(const TriangleMesh& mesh, std::uint32_t triangle, const Eigen::Vector3d& point) {
  const std::array<Eigen::Vector3d, 3> corners = corners_of(mesh, triangle);
  const Eigen::Vector3d normal = normal_of(mesh, triangle);
  bool above = true;
  double distance = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector3d &a = corners[i], &b = corners[(i + 1) % 3];
    above = above && normal.cross(b - a).dot(point - a) >= 0;
    distance = std::min(distance, distance_to_segment(a, b, point));
  }
  return above ? std::abs(normal.dot(point - corners[0])) : distance;
}

double area_inside_square(const std::array<Eigen::Vector2d, 3>& triangle, double half_side) {
  // Sutherland and Hodgman: cut the polygon with the square's sides, one after the other.
  std::vector<Eigen::Vector2d> polygon(triangle.begin(), triangle.end());
  for (const Eigen::Vector2d& side : {Eigen::Vector2d(1, 0), Eigen::Vector2d(-1, 0),
                                      Eigen::Vector2d(0, 1), Eigen::Vector2d(0, -1)}) {
    std::vector<Eigen::Vector2d> cut;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      const double inside_a = half_side - side.dot(a), inside_b = half_side - side.dot(b);
      if (inside_a >= 0) cut.push_back(a);
      if ((inside_a >= 0) != (inside_b >= 0)) {
        cut.push_back(a + inside_a / (inside_a - inside_b) * (b - a));
      }
    }
    polygon = std::move(cut);
  }
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return std::abs(twice) / 2;
}

}  // namespace vantage::simulator::detail
