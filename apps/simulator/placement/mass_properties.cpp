#include "simulator/placement/mass_properties.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

// Of the sum of all faces' areas, and of the cube around the mesh: room for corners in floats.
constexpr double kOpen = 1e-4;
constexpr double kFlat = 1e-9;

struct Sums {
  Eigen::Vector3d area = Eigen::Vector3d::Zero();  // the faces' areas as vectors along the normals
  double all_area = 0;                             // the same without directions
  double volume = 0;                               // of the tetrahedra over the faces
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // their centroids times their volumes
};

// The tip of the tetrahedra is near the mesh, so that large coordinates do not cancel.
Sums sum_up(const TriangleMesh& mesh, const Eigen::Vector3d& tip) {
  Sums sums;
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
    const Eigen::Vector3d a = mesh.corner(i, 0).cast<double>() - tip;
    const Eigen::Vector3d b = mesh.corner(i, 1).cast<double>() - tip;
    const Eigen::Vector3d c = mesh.corner(i, 2).cast<double>() - tip;
    const Eigen::Vector3d area = 0.5 * (b - a).cross(c - a);
    const double volume = a.dot(b.cross(c)) / 6;
    sums.area += area;
    sums.all_area += area.norm();
    sums.volume += volume;
    sums.moment += volume / 4 * (a + b + c);
  }
  return sums;
}

}  // namespace

MassProperties mass_properties(const TriangleMesh& mesh) {
  if (mesh.empty()) throw bad_input("mesh", "it has no triangles, so it has no volume");
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& point : surface_points(mesh)) bounds.extend(point);
  const Sums sums = sum_up(mesh, bounds.center());

  // The area vectors of a closed surface cancel; what is left of them is the size of its holes.
  if (sums.area.norm() > kOpen * sums.all_area) {
    throw bad_input("mesh", fmt::format("its surface is open: it has a hole of about {:.3g} m² in "
                                        "{:.3g} m²; expected a closed surface: close the hole",
                                        sums.area.norm(), sums.all_area));
  }
  const double edge = bounds.sizes().maxCoeff(), least = kFlat * edge * edge * edge;
  if (sums.volume <= least) {
    throw bad_input(
        "mesh",
        fmt::format("its volume is {:.3g} m³; expected more than {:.3g} m³{}", sums.volume, least,
                    sums.volume < -least ? ": its faces point inwards; flip them"
                                         : ": a body with an inside"));
  }
  return {sums.volume, bounds.center() + sums.moment / sums.volume};
}

std::vector<Eigen::Vector3d> surface_points(const TriangleMesh& mesh) {
  std::vector<bool> used(mesh.vertices().size());
  for (const Triangle& triangle : mesh.triangles()) {
    for (const std::uint32_t corner : triangle) used[corner] = true;
  }
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i]) points.push_back(mesh.vertices()[i].cast<double>());
  }
  return points;
}

}  // namespace vantage
