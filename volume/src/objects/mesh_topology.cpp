#include "objects/mesh_topology.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <tuple>

namespace vantage::volume::detail {
namespace {

/// For each vertex the first one at its place.
std::vector<std::uint32_t> weld(const std::vector<Eigen::Vector3f>& vertices) {
  const auto place = [&](std::uint32_t v) {
    return std::tuple(vertices[v].x(), vertices[v].y(), vertices[v].z());
  };
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::tuple(place(a), a) < std::tuple(place(b), b);
  });
  std::vector<std::uint32_t> first(vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && place(order[i]) == place(order[i - 1]);
    first[order[i]] = same ? first[order[i - 1]] : order[i];
  }
  return first;
}

/// One triangle's side, with its ends in ascending order.
struct Side {
  std::uint32_t low, high, triangle;
  bool ascending;  ///< whether the triangle passes it from `low` to `high`
};

std::vector<Side> sorted_sides(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> first = weld(mesh.vertices());
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles().size());
  for (std::uint32_t t = 0; t < mesh.triangles().size(); ++t) {
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = first[mesh.triangles()[t][c]];
      const std::uint32_t b = first[mesh.triangles()[t][(c + 1) % 3]];
      sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tuple(a.low, a.high, a.triangle) < std::tuple(b.low, b.high, b.triangle);
  });
  return sides;
}

FacePlane face_plane(const TriangleMesh& mesh, std::size_t triangle) {
  const Eigen::Vector3d a = mesh.corner(triangle, 0).cast<double>();
  const Eigen::Vector3d u = mesh.corner(triangle, 1).cast<double>() - a;
  const Eigen::Vector3d v = mesh.corner(triangle, 2).cast<double>() - a;
  const Eigen::Vector3d normal = u.cross(v).normalized();
  return {normal, normal.dot(a)};
}

}  // namespace

MeshTopology::MeshTopology(const TriangleMesh& mesh) {
  planes.reserve(mesh.triangles().size());
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) planes.push_back(face_plane(mesh, t));
  const std::vector<Side> sides = sorted_sides(mesh);
  std::size_t odd = 0, unbalanced = 0;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i;
    std::ptrdiff_t balance = 0;
    for (; end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high;
         ++end) {
      balance += sides[end].ascending ? 1 : -1;
    }
    odd += (end - i) % 2;
    unbalanced += balance != 0;
    const bool regular = end - i == 2 && balance == 0;
    edges.push_back({sides[i].low, sides[i].high, sides[i].triangle,
                     regular ? sides[i + 1].triangle : kNoTriangle});
    i = end;
  }
  closure = unbalanced == 0 ? Closure::oriented : odd == 0 ? Closure::even : Closure::open;
  unmatched_edges = closure == Closure::open ? odd : 0;
}

}  // namespace vantage::volume::detail
