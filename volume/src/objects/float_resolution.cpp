#include "objects/float_resolution.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>

#include "objects/known_objects.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::volume::detail {
namespace {

constexpr double kVoxelShare = 0.1;

/// Between a coordinate and the next float.
double float_step(double coordinate) {
  if (std::abs(coordinate) >= double(std::numeric_limits<float>::max())) {
    return std::abs(coordinate) * double(std::numeric_limits<float>::epsilon());
  }
  const float from = std::abs(float(coordinate));
  return double(std::nextafter(from, std::numeric_limits<float>::infinity())) - double(from);
}

void check_point(const Eigen::Vector3d& point, double voxel_size_m, const std::string& where) {
  const double reach = point.cwiseAbs().maxCoeff();
  if (float_step(reach) <= kVoxelShare * voxel_size_m) return;
  throw bad_input(
      where,
      fmt::format("reaches {:.9g} m from the origin, where coordinates are rounded to {:.3g} m; "
                  "expected a tenth of the voxel size of {:g} m or less: put the origin of all "
                  "coordinates near the work area, or use larger voxels",
                  reach, float_step(reach), voxel_size_m));
}

/// The nearest that a mesh comes to the planes through its origin: all of it is as coarse or
/// coarser.
Eigen::Vector3d nearest_coordinates(const TriangleMesh& mesh) {
  Eigen::Array3f nearest = Eigen::Array3f::Constant(std::numeric_limits<float>::max());
  for (const Eigen::Vector3f& p : mesh.vertices()) nearest = nearest.min(p.array().abs());
  return mesh.empty() ? Eigen::Vector3d::Zero() : Eigen::Vector3d(nearest.matrix().cast<double>());
}

}  // namespace

void check_float_resolution(const WorldModel& world, const GridGeometry& geometry) {
  const double voxel_size_m = geometry.voxel_size_m();
  check_point(geometry.box().min(), voxel_size_m, "work area");
  check_point(geometry.box().max(), voxel_size_m, "work area");
  for (const DepthCamera& camera : world.cameras) {
    check_point(camera.camera.centre(), voxel_size_m, "camera " + camera.name);
  }
  for_each_known(world, [&](const KnownObject& object) {
    check_point(nearest_coordinates(*object.mesh), voxel_size_m,
                "object " + object.name + ": its mesh");
  });
}

}  // namespace vantage::volume::detail
