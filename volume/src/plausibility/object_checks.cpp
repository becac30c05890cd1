#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "objects/mesh_topology.hpp"
#include "plausibility/checks.hpp"
#include "vantage/raycore/detail/mesh_measures.hpp"

namespace vantage::volume::detail {
namespace {

constexpr double kWideArea_m = 20;

using raycore::detail::bounds_of;
using raycore::detail::winding_number;

void check_inside(const KnownObject& solid, const Eigen::AlignedBox3d& bounds,
                  const std::vector<DepthCamera>& cameras, Findings& findings) {
  for (const DepthCamera& camera : cameras) {
    const Eigen::Vector3d centre = solid.T_world_object.inverse() * camera.camera.centre();
    if (!bounds.contains(centre)) continue;
    if (MeshTopology(*solid.mesh).closure == Closure::open) continue;
    if (std::abs(winding_number(*solid.mesh, centre)) < 0.5) continue;
    findings.push_back(fmt::format(
        "image {}: the camera stands inside {}, which hides everything from it: move one of them, "
        "or leave the housing of a camera out of the static structures",
        camera.name, solid.name));
  }
}

void check_size(const KnownObject& object, const Eigen::AlignedBox3d& bounds, double widest_m,
                double voxel_size_m, Findings& findings) {
  const double extent = bounds.sizes().maxCoeff();
  if (extent < voxel_size_m) {
    findings.push_back(
        fmt::format("{}: it is {:.3g} m large, less than a voxel of {:.3g} m: is its mesh in "
                    "another unit (unit_m), or the voxel too large for it?",
                    object.name, extent, voxel_size_m));
  } else if (extent > widest_m) {
    findings.push_back(
        fmt::format("{}: it is {:.4g} m large: is its mesh in millimetres "
                    "(unit_m: 0.001)?",
                    object.name, extent));
  }
}

void check_place(const KnownObject& object, const Eigen::AlignedBox3d& bounds, const Box& work_area,
                 Findings& findings) {
  const Eigen::Vector3d centre = object.T_world_object * bounds.center();
  const double radius = 0.5 * bounds.sizes().norm();
  const double diagonal = work_area.size().norm();
  const double away = (centre - work_area.centre()).norm() - radius - 0.5 * diagonal;
  if (away < 20 * diagonal || away < 5) return;
  findings.push_back(
      fmt::format("{}: it lies {:.4g} m away from the work area: is its position in "
                  "millimetres, where metres are expected?",
                  object.name, away));
}

}  // namespace

void check_objects(const WorldModel& world, const Box& work_area, double voxel_size_m,
                   Findings& findings) {
  const double diagonal = work_area.size().norm();
  if (work_area.size().maxCoeff() > kWideArea_m) {
    findings.push_back(
        fmt::format("the work area is {:.4g} m x {:.4g} m x {:.4g} m large: are "
                    "these millimetres? Metres are expected",
                    work_area.size().x(), work_area.size().y(), work_area.size().z()));
  }
  for (const KnownObject& object : world.objects) {
    const Eigen::AlignedBox3d bounds = bounds_of(*object.mesh);
    if (bounds.isEmpty()) continue;
    check_inside(object, bounds, world.cameras, findings);
    check_size(object, bounds, std::max(10.0, 10 * diagonal), voxel_size_m, findings);
    check_place(object, bounds, work_area, findings);
  }
  for (const KnownObject& structure : world.static_structures) {
    const Eigen::AlignedBox3d bounds = bounds_of(*structure.mesh);
    if (bounds.isEmpty()) continue;
    check_inside(structure, bounds, world.cameras, findings);
    check_size(structure, bounds, std::max(100.0, 50 * diagonal), voxel_size_m, findings);
  }
}

}  // namespace vantage::volume::detail
