#include "simulator/placement/mass_properties.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "vantage/raycore/detail/mesh_measures.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

// Of the sum of all faces' areas, and of the cube around the mesh: room for corners in floats.
constexpr double kOpen = 1e-4;
constexpr double kFlat = 1e-9;

}  // namespace

MassProperties mass_properties(const TriangleMesh& mesh) {
  if (mesh.empty()) throw bad_input("mesh", "it has no triangles, so it has no volume");
  Eigen::AlignedBox3d bounds;
  for (const Eigen::Vector3d& point : surface_points(mesh)) bounds.extend(point);
  const auto sums = raycore::detail::enclosed_volume(mesh);

  // The area vectors of a closed surface cancel; what is left of them is the size of its holes.
  if (sums.open_m2.norm() > kOpen * sums.area_m2) {
    throw bad_input("mesh", fmt::format("its surface is open: it has a hole of about {:.3g} m² in "
                                        "{:.3g} m²; expected a closed surface: close the hole",
                                        sums.open_m2.norm(), sums.area_m2));
  }
  const double edge = bounds.sizes().maxCoeff(), least = kFlat * edge * edge * edge;
  if (sums.volume_m3 <= least) {
    throw bad_input("mesh",
                    fmt::format("its volume is {:.3g} m³; expected more than {:.3g} m³{}",
                                sums.volume_m3, least,
                                sums.volume_m3 < -least ? ": its faces point inwards; flip them"
                                                        : ": a body with an inside"));
  }
  return {sums.volume_m3, sums.centre};
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
