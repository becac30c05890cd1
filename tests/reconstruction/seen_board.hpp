#pragma once

#include <vector>

#include "reconstruction/seen_markers.hpp"
#include "vantage/reconstruction/locate_camera.hpp"

namespace vantage::test {

/// Markers on a board, or anywhere, and a camera that sees them. World's frame.
struct SeenBoard {
  std::vector<ObjectFeature> features;
  std::vector<Observation> observations;
  Pose T_world_cam;

  void add_marker(int id, double size_m, const Pose& T_world_marker) {
    features.push_back(marker_feature({"4X4_50", id, size_m, T_world_marker}));
  }

  /// columns × rows markers on the plane z = 0 around the origin.
  static SeenBoard grid(int columns, int rows, double size_m, double spacing_m) {
    SeenBoard board;
    for (int i = 0; i < columns * rows; ++i) {
      board.add_marker(i, size_m,
                       Pose::from_translation({spacing_m * (i % columns - (columns - 1) / 2.0),
                                               spacing_m * (i / columns - (rows - 1) / 2.0), 0}));
    }
    return board;
  }

  /// Every marker is seen, with noise of `sigma_px` and what the camera takes for it.
  void look(const Lens& lens, const Pose& camera, double sigma_px, Random& random) {
    T_world_cam = camera;
    observations.clear();
    for (const ObjectFeature& feature : features) {
      const auto term = seen_marker(lens, camera.inverse(), {}, feature.points(), sigma_px, random);
      observations.push_back({feature.key, SeenPoints{term.pixels, term.sigma_px}});
    }
  }

  std::vector<Eigen::Vector2d>& pixels(std::size_t i) {
    return std::get<SeenPoints>(observations[i].data).pixels;
  }
};

/// A camera that looks to within 5 cm of the origin, `tilt` radians from the z axis, turned about
/// its own axis by any angle.
inline Pose camera_above(double distance_m, double tilt, Random& random) {
  const double azimuth = random.uniform(0, 2 * std::numbers::pi);
  const Eigen::Vector3d towards(std::sin(tilt) * std::cos(azimuth),
                                std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
  const Eigen::Vector3d target = random.in_cube(0.05);
  const Eigen::AngleAxisd roll(random.uniform(0, 2 * std::numbers::pi), Eigen::Vector3d::UnitZ());
  return Pose::looking_at(target + distance_m * towards, target) *
         Pose::from_rotation(roll.matrix(), {0, 0, 0});
}

/// A marker within a cube, up to 35° from the horizontal.
inline Pose facing_up(double half, Random& random) {
  const double azimuth = random.uniform(0, 2 * std::numbers::pi);
  const Eigen::Vector3d axis(std::cos(azimuth), std::sin(azimuth), 0);
  const Eigen::AngleAxisd tilt(random.uniform(0, 0.6), axis);
  const Eigen::AngleAxisd turn(random.uniform(0, 2 * std::numbers::pi), Eigen::Vector3d::UnitZ());
  return Pose::from_rotation((tilt * turn).toRotationMatrix(), random.in_cube(half));
}

inline double turn_between(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(a.rotation().transpose() * b.rotation())).angle();
}

}  // namespace vantage::test
