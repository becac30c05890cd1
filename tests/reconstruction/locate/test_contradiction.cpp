#include <doctest/doctest.h>

#include <Eigen/Cholesky>

#include "reconstruction/seen_board.hpp"
#include "reference/plain_least_squares.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

constexpr double kNoise_px = 0.05;

/// Markers around the edge of a board, as people print them.
SeenBoard ring() {
  SeenBoard board;
  int id = 0;
  for (const auto& [x, y] : {std::pair(-0.2, -0.12),
                             {0.0, -0.12},
                             {0.2, -0.12},
                             {0.2, 0.0},
                             {0.2, 0.12},
                             {0.0, 0.12},
                             {-0.2, 0.12},
                             {-0.2, 0.0}}) {
    board.add_marker(id++, 0.05, Pose::from_translation({x, y, 0}));
  }
  return board;
}

Lens pinhole(double factor = 1, double resolution = 1) {
  const Intrinsics k{1280,
                     720,
                     900 * factor * resolution,
                     900 * factor * resolution,
                     resolution * 639.5,
                     resolution * 359.5};
  return Lens(k, {});
}

Pose slanted_camera(Random& random) {
  return camera_above(random.uniform(0.75, 0.95), random.uniform(0.5, 0.9), random);
}

bool says(const std::string& text, const char* words) {
  return text.find(words) != std::string::npos;
}

std::string all_text(const CameraLocation& found) {
  return found.reason + found.warning;
}

}  // namespace

TEST_CASE("a right calibration and board are not warned of") {
  Random random(3);
  for (std::uint32_t scene = 0; scene < scene_count(40); ++scene) {
    CAPTURE(scene);
    SeenBoard board = ring();
    board.look(pinhole(), slanted_camera(random), kNoise_px, random);
    const CameraLocation found = locate_camera(pinhole(), board.observations, board.features);
    REQUIRE(found.pose);
    CAPTURE(found.warning);
    CHECK(found.warning.empty());
    CHECK(found.markers_seen == 8);
  }
}

TEST_CASE("a wrong focal length is named, and the covariance covers what it does to the pose") {
  Random random(4);
  std::uint32_t named = 0, located = 0;
  const std::uint32_t scenes = scene_count(30);
  for (std::uint32_t scene = 0; scene < scenes; ++scene) {
    CAPTURE(scene);
    SeenBoard board = ring();
    board.look(pinhole(), slanted_camera(random), kNoise_px, random);
    const double factor = scene % 2 ? random.uniform(1.02, 1.05) : random.uniform(1.2, 1.5);
    const CameraLocation found = locate_camera(pinhole(factor), board.observations, board.features);
    CAPTURE(all_text(found));
    named += says(all_text(found), "focal length");
    if (!found.pose) continue;
    ++located;
    const auto off = step_between(found.pose->T_world_cam, board.T_world_cam);
    CHECK(off.dot(found.pose->covariance.ldlt().solve(off)) < 22.5);  // 99.9 %, six coordinates
  }
  MESSAGE("named in ", named, " of ", scenes, ", located ", located);
  CHECK(named >= enough(27));
}

TEST_CASE("other mistakes are named: resolution, axes, sizes, parity") {
  Random random(5);
  const std::uint32_t scenes = scene_count(10);
  std::uint32_t resolution = 0, axis = 0, size = 0, parity = 0;
  for (std::uint32_t scene = 0; scene < scenes; ++scene) {
    CAPTURE(scene);
    const Pose camera = slanted_camera(random);
    SeenBoard board = ring();
    board.look(pinhole(), camera, kNoise_px, random);
    resolution += says(all_text(locate_camera(pinhole(1, 2), board.observations, board.features)),
                       "another resolution");

    SeenBoard mirrored = ring();
    for (ObjectFeature& feature : mirrored.features) {
      auto& marker = std::get<Marker>(feature.geometry);
      const Eigen::Vector3d at = marker.T_object_marker.translation();
      marker.T_object_marker = Pose::from_translation({at.x(), -at.y(), at.z()});
    }
    axis += says(all_text(locate_camera(pinhole(), board.observations, mirrored.features)),
                 "points the other way");

    SeenBoard large = ring();
    for (ObjectFeature& feature : large.features) {
      std::get<Marker>(feature.geometry).size_m *= 1.4;
    }
    size += says(all_text(locate_camera(pinhole(), board.observations, large.features)),
                 "times as large as size_m says");

    SeenBoard light, dark;
    int id = 0;
    for (int row = 0; row < 5; ++row) {
      for (int column = 0; column < 4; ++column) {
        if ((row + column) % 2) continue;
        const double y = 0.054 * (2 - row);
        light.add_marker(id, 0.04, Pose::from_translation({0.054 * column, y, 0}));
        dark.add_marker(id++, 0.04, Pose::from_translation({0.054 * (column ^ 1), y, 0}));
      }
    }
    light.look(pinhole(), camera, kNoise_px, random);
    const CameraLocation found = locate_camera(pinhole(), light.observations, dark.features);
    CHECK_FALSE(found.pose);
    parity += says(found.reason, "parity");
  }
  CHECK(resolution >= enough(9));
  CHECK(axis >= enough(9));
  CHECK(size >= enough(9));
  CHECK(parity == scenes);
}

TEST_CASE("moved markers are counted, and without a clear majority there is no pose") {
  Random random(6);
  for (std::uint32_t scene = 0; scene < scene_count(20); ++scene) {
    CAPTURE(scene);
    SeenBoard board = ring();
    board.look(pinhole(), slanted_camera(random), kNoise_px, random);
    SeenBoard one = board, many = board;
    for (Eigen::Vector2d& pixel : one.pixels(2)) pixel.x() += 25;
    const CameraLocation found = locate_camera(pinhole(), one.observations, one.features);
    REQUIRE(found.pose);
    CHECK(says(found.warning, "1 of the 8 markers"));
    CHECK(says(found.warning, "4X4/2"));
    CHECK(step_between(found.pose->T_world_cam, board.T_world_cam).norm() < 0.01);

    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector2d shift(random.uniform(20, 60), random.uniform(-60, 60));
      for (Eigen::Vector2d& pixel : many.pixels(2 * i)) pixel += shift;
    }
    CHECK_FALSE(locate_camera(pinhole(), many.observations, many.features).pose);
  }
}

TEST_CASE("the same marker twice contradicts nothing") {
  Random random(7);
  SeenBoard board = ring();
  board.look(pinhole(), slanted_camera(random), kNoise_px, random);
  Observation copy = board.observations[3];
  for (Eigen::Vector2d& pixel : std::get<SeenPoints>(copy.data).pixels) pixel.y() += 40;
  board.observations.push_back(copy);
  const CameraLocation found = locate_camera(pinhole(), board.observations, board.features);
  REQUIRE(found.pose);
  CHECK(found.warning.empty());
  CHECK(found.markers_seen == 8);
  CHECK(found.outliers.size() == 1);
}

TEST_CASE("one marker on a bent sheet gives no confident pose that is wrong by tens of degrees") {
  Random random(8);
  const std::uint32_t scenes = scene_count(150);
  std::uint32_t located = 0, wrong = 0;
  for (std::uint32_t scene = 0; scene < scenes; ++scene) {
    SeenBoard board;
    board.add_marker(0, 0.08, Pose());
    SeenBoard bent = board;
    bent.look(pinhole(), camera_above(random.uniform(1.2, 2.2), random.uniform(0.3, 0.9), random),
              0.03, random);
    // A saddle of 0.5 mm: the corners leave the plane in turns.
    const Pose T_cam_world = bent.T_world_cam.inverse();
    auto corners = bent.features[0].points();
    for (std::size_t i = 0; i < 4; ++i) {
      const Eigen::Vector3d flat = T_cam_world * corners[i];
      corners[i].z() += i % 2 ? 0.0005 : -0.0005;
      bent.pixels(0)[i] += pinhole().project(T_cam_world * corners[i]) - pinhole().project(flat);
    }
    const CameraLocation found = locate_camera(pinhole(), bent.observations, bent.features);
    if (!found.pose) continue;
    ++located;
    wrong += turn_between(found.pose->T_world_cam, bent.T_world_cam) > 0.2;
  }
  MESSAGE(located, " of ", scenes, " located, ", wrong, " by the wrong tilt");
  CHECK(located >= enough(1));
  CHECK(wrong == 0);
}

}  // namespace vantage::test
