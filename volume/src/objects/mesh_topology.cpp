#include "objects/mesh_topology.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

namespace vantage::volume::detail {
namespace {

/// One triangle's side, with its ends in ascending order.
struct Side {
  std::uint32_t low, high, triangle;
  bool ascending;  ///< whether the triangle passes it from `low` to `high`
};

std::vector<Side> sorted_sides(const TriangleMesh& mesh) {
  const std::vector<std::uint32_t> first = welded(mesh.vertices(), 0);
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

/// The corner of a triangle that is not on a side of it, as a place.
Eigen::Vector3f opposite(const TriangleMesh& mesh, std::uint32_t triangle, const Side& side) {
  const Eigen::Vector3f &a = mesh.vertices()[side.low], &b = mesh.vertices()[side.high];
  for (int c = 0; c < 3; ++c) {
    const Eigen::Vector3f& p = mesh.corner(triangle, c);
    if (p != a && p != b) return p;
  }
  return a;
}

/// Whether the winding number just before and just behind a triangle are those of an outside and an
/// inside.
bool bounds_a_solid(const SolidSurface& solid, const Triangle& t, const WindingNumber& winding) {
  const Eigen::Vector3d a = solid.vertices[t[0]].cast<double>();
  const Eigen::Vector3d b = solid.vertices[t[1]].cast<double>();
  const Eigen::Vector3d c = solid.vertices[t[2]].cast<double>();
  const Eigen::Vector3d doubled_area = (b - a).cross(c - a);
  const double size = doubled_area.norm();
  if (!(size > 0)) return true;  // no area, no surface
  const Eigen::Vector3d middle = (a + b + c) / 3, step = 1e-3 * doubled_area / std::sqrt(size);
  const double before = std::abs(winding.at(middle + step));
  const double behind = std::abs(winding.at(middle - step));
  return std::min(before, behind) < 0.25 && std::max(before, behind) > 0.75;
}

std::vector<Triangle> sheets_of(const SolidSurface& solid, const WindingNumber& winding) {
  std::vector<std::uint8_t> is_sheet(solid.triangles.size());
  tbb::parallel_for(std::size_t(0), is_sheet.size(), [&](std::size_t t) {
    is_sheet[t] = !bounds_a_solid(solid, solid.triangles[t], winding);
  });
  std::vector<Triangle> sheets;
  for (std::size_t t = 0; t < is_sheet.size(); ++t) {
    if (is_sheet[t] != 0) sheets.push_back(solid.triangles[t]);
  }
  return sheets;
}

}  // namespace

void MeshTopology::decide_inside(const TriangleMesh& mesh, bool faces_are_paired) {
  if (mesh.empty() || (closure != Closure::open && !faces_are_paired)) return;
  solid = std::make_shared<const SolidSurface>(solid_surface(mesh, closure == Closure::open));
  if (closure != Closure::open && solid->triangles.size() == mesh.triangles().size()) {
    solid = nullptr;  // parts that touch at an edge, and nothing twice
    return;
  }
  const EdgeBalance balance(solid->triangles);
  closure = balance.closure();
  unmatched_edges = closure == Closure::open ? balance.odd : 0;
  if (closure != Closure::open) return;
  winding = std::make_shared<const WindingNumber>(solid->vertices, solid->triangles);
  sheets = sheets_of(*solid, *winding);
}

MeshTopology::MeshTopology(const TriangleMesh& mesh) {
  planes.reserve(mesh.triangles().size());
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) planes.push_back(face_plane(mesh, t));
  const std::vector<Side> sides = sorted_sides(mesh);
  std::size_t odd = 0, unbalanced = 0;
  bool paired = false;  // whether a triangle may be there twice
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
    paired = paired || end - i > 2 ||
             (end - i == 2 && opposite(mesh, sides[i].triangle, sides[i]) ==
                                  opposite(mesh, sides[i + 1].triangle, sides[i]));
    i = end;
  }
  closure = unbalanced == 0 ? Closure::oriented : odd == 0 ? Closure::even : Closure::open;
  unmatched_edges = closure == Closure::open ? odd : 0;
  decide_inside(mesh, paired);
}

}  // namespace vantage::volume::detail
