#include <doctest/doctest.h>

#include <cmath>

#include "reference/random_boxes.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "volume/volume_modes.hpp"

namespace vantage {
namespace {

const Eigen::Vector3d kEye(0.05, -0.1, 0.9);

/// Three turned boxes whose shadows, seen from `kEye`, lie apart from each other and end on the
/// floor, within the work area.
std::vector<test::TurnedBox> boxes() {
  const auto turned = [](const Eigen::Vector3d& axis, double angle, const Eigen::Vector3d& centre) {
    return Pose::from_rotation(Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix(),
                               centre);
  };
  return {{{0.02, 0.03, 0.015}, turned({1, 2, 3}, 0.7, {-0.08, -0.07, 0.07})},
          {{0.025, 0.015, 0.02}, turned({-2, 1, 1}, 1.1, {0.08, -0.06, 0.06})},
          {{0.015, 0.02, 0.03}, turned({1, -1, 2}, 2.0, {0.0, 0.07, 0.065})}};
}

double pyramid(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return std::abs((a - kEye).dot((b - kEye).cross(c - kEye))) / 6;
}

/// The exact volume that a box hides above the floor at `floor_z`. Rays enter the box through
/// triangles that look at the camera, and all that follows is box or hidden: the pyramid between
/// camera and floor less the pyramid between camera and triangle, and in the end less the box.
double hidden_volume(const test::TurnedBox& box, double floor_z) {
  const TriangleMesh mesh =
      TriangleMesh::from_box(Box(-box.half, box.half)).transformed(box.T_world_box);
  double volume = -8 * box.half.prod();
  for (std::size_t t = 0; t < mesh.triangles().size(); ++t) {
    Eigen::Vector3d p[3], on_floor[3];
    for (int c = 0; c < 3; ++c) {
      p[c] = mesh.corner(t, c).cast<double>();
      on_floor[c] = kEye + (kEye.z() - floor_z) / (kEye.z() - p[c].z()) * (p[c] - kEye);
    }
    if ((p[1] - p[0]).cross(p[2] - p[0]).dot(kEye - p[0]) <= 0) continue;
    volume += pyramid(on_floor[0], on_floor[1], on_floor[2]) - pyramid(p[0], p[1], p[2]);
  }
  return volume;
}

/// Errors of the shadow's and the known objects' volume, relative to the true ones.
struct Errors {
  double shadow = 0, occupied = 0;
};

/// Root mean squares over grids that are shifted by parts of a voxel: how a single grid happens to
/// lie says nothing about the order.
Errors errors_at(double voxel_size_m, const VolumeOptions& options) {
  test::BoxWorld world{boxes(), {}, GridGeometry::covering(Box({0, 0, 0}, {1, 1, 1}), 1)};
  world.cameras.push_back(
      {{640, 480, 700, 700, 319.5, 239.5}, Pose::looking_at(kEye, {0, 0, 0.05}), {0.1, 2}});
  const WorldModel model = world.model();
  Errors sum;
  constexpr int kShifts = 9;
  for (int n = 0; n < kShifts; ++n) {
    // Multiples of the golden ratio's relatives fill the unit cube evenly.
    const Eigen::Vector3d part(std::fmod(n * 0.8191725134, 1), std::fmod(n * 0.6710436067, 1),
                               std::fmod(n * 0.5497004779, 1));
    const Eigen::Vector3d low = Eigen::Vector3d(-0.16, -0.16, 0) - voxel_size_m * part;
    const Box area(low, low + Eigen::Vector3d(0.34, 0.34, 0.16));
    const auto grid = classify(model, GridGeometry::covering(area, voxel_size_m), options);
    REQUIRE(grid->report().outside_shadow == 0);
    double shadow = 0, occupied = 0;
    for (const test::TurnedBox& box : world.boxes) {
      shadow += hidden_volume(box, low.z());
      occupied += 8 * box.half.prod();
    }
    sum.shadow += std::pow(grid->volume_m3(VoxelState::shadow) / shadow - 1, 2);
    sum.occupied += std::pow(grid->volume_m3(VoxelState::occupied) / occupied - 1, 2);
  }
  return {std::sqrt(sum.shadow / kShifts), std::sqrt(sum.occupied / kShifts)};
}

/// The slope of log(error) over log(size), by least squares.
double fitted_order(const std::vector<double>& sizes, const std::vector<double>& errors) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const double x = std::log(sizes[i]), y = std::log(errors[i]);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

struct Orders {
  double shadow, occupied, finest_shadow_error;
};

Orders measure(const VolumeOptions& options, const std::string& name) {
  const std::vector<double> sizes = {0.02, 0.01, 0.005, 0.0025};
  std::vector<double> shadow, occupied;
  for (const double size : sizes) {
    const Errors errors = errors_at(size, options);
    shadow.push_back(errors.shadow);
    occupied.push_back(errors.occupied);
    MESSAGE(name << ", " << 1e3 * size << " mm: relative error of the shadow " << errors.shadow
                 << ", of the objects " << errors.occupied);
  }
  const Orders orders{fitted_order(sizes, shadow), fitted_order(sizes, occupied), shadow.back()};
  MESSAGE(name << ": order " << orders.shadow << " for the shadow, " << orders.occupied
               << " for the objects");
  return orders;
}

}  // namespace

TEST_CASE("volumes converge to the exact ones as voxels shrink, in mesh mode beyond first order") {
  const Orders mesh = measure({}, "mesh");
  CHECK(mesh.shadow > 1.2);
  CHECK(mesh.occupied > 1.2);
  CHECK(mesh.finest_shadow_error < 0.002);

  // What is cast by steps instead of faces is worse.
  const Orders voxels = measure(test::volume_mode(OccluderMode::voxels, false), "voxels");
  CHECK(voxels.shadow > 0.8);
  CHECK(voxels.finest_shadow_error > mesh.finest_shadow_error);
  const Orders smooth = measure(test::volume_mode(OccluderMode::voxels), "voxels, anti-aliased");
  CHECK(smooth.shadow > 0.8);
}

}  // namespace vantage
