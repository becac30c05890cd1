// OpenCV finds the markers in simulated photographs as it does in real ones.

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <numbers>
#include <vector>

#include "simulator/color_scenes.hpp"
#include "simulator/markers/marker_print.hpp"
#include "support/marker_tally.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

constexpr double kCube = 0.05, kMarker = 0.04;
const Intrinsics kIntrinsics{640, 480, 615, 615, 319.5, 239.5};

/// A marker in the middle of each side of a cube; their up is the cube's where it can be.
std::vector<Marker> markers_on_cube(int first_id) {
  std::vector<Marker> markers;
  for (int side = 0; side < 6; ++side) {
    const Eigen::Vector3d out = Eigen::Vector3d::Unit(side % 3) * (side < 3 ? 1 : -1);
    const Eigen::Vector3d up = Eigen::Vector3d::Unit(side % 3 == 2 ? 1 : 2);
    Eigen::Matrix3d rotation;
    rotation << up.cross(out), up, out;
    markers.push_back(
        {"4X4_50", first_id + side, kMarker, Pose::from_rotation(rotation, kCube / 2 * out)});
  }
  return markers;
}

struct MarkedScene {
  std::vector<SimulatedBody> bodies;
  std::vector<std::pair<Marker, Pose>> markers;  ///< with the pose of the cube

  /// Seven cubes turned at random: five stand on a board, two on others of them.
  explicit MarkedScene(Random& random) {
    bodies.push_back(box_body(Box({-0.25, -0.175, -0.012}, {0.25, 0.175, 0}), {0.9f, 0.9f, 0.88f}));
    bodies.push_back(box_body(Box({-1, -1, -0.05}, {1, 1, -0.012}), {0.62f, 0.60f, 0.58f}));
    for (int i = 0; i < 7; ++i) {
      const int slot = i % 5;
      const double x = 0.11 * (slot % 3) - 0.1 + random.uniform(-0.01, 0.01);
      const double y = 0.12 * (slot / 3) - 0.06 + random.uniform(-0.01, 0.01);
      const double z = kCube * (i < 5 ? 0.5 : 1.5), turn = random.uniform(0, 2 * std::numbers::pi);
      add_cube(
          6 * i, random,
          Pose::from_rotation(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
                              {x, y, z}));
    }
  }

  void add_cube(int first_id, Random& random, const Pose& pose) {
    const double h = kCube / 2;
    const Eigen::Vector3f color(float(random.uniform(0.1, 0.9)), float(random.uniform(0.1, 0.9)),
                                float(random.uniform(0.1, 0.9)));
    const std::vector<Marker> cube = markers_on_cube(first_id);
    auto shape = std::make_shared<TexturedMesh>(
        with_markers(TriangleMesh::from_box(Box({-h, -h, -h}, {h, h, h})), color, cube, "cube"));
    bodies.push_back({"cube", std::move(shape), pose});
    for (const Marker& marker : cube) markers.emplace_back(marker, pose);
  }
};

/// Looks for the markers of a scene in a photograph of it.
void look_for(const MarkedScene& marked, const SimulatedScene& scene, const PinholeCamera& camera,
              const ColorSensor& sensor, std::uint64_t seed, MarkerTally& tally) {
  const ColorImage image = *simulate_color(scene, {}, camera, sensor, seed);
  const std::vector<DetectedMarker> found = detect_markers(image, "4X4_50");
  CAPTURE(seed);
  for (const auto& [marker, pose] : marked.markers) {
    tally.look_for(marker, pose, scene.rays(), camera, found);
  }
}

MarkerTally look_from_all_sides(const ColorSensor& sensor, std::uint32_t first_seed, int scenes) {
  MarkerTally tally;
  for (std::uint32_t seed = first_seed; seed < first_seed + std::uint32_t(scenes); ++seed) {
    Random random(seed);
    const MarkedScene marked(random);
    const SimulatedScene scene(marked.bodies);
    for (int view = 0; view < 4; ++view) {
      const double around = random.uniform(0, 2 * std::numbers::pi);
      const double up = random.uniform(0.3, 1.4), distance = random.uniform(0.3, 0.85);
      const Eigen::Vector3d eye(distance * std::cos(up) * std::cos(around),
                                distance * std::cos(up) * std::sin(around),
                                0.03 + distance * std::sin(up));
      const PinholeCamera camera(kIntrinsics, Pose::looking_at(eye, {0, 0, 0.03}));
      look_for(marked, scene, camera, sensor, 4 * seed + std::uint64_t(view), tally);
    }
  }
  return tally;
}

}  // namespace

TEST_CASE("OpenCV finds every marker that is large, in front and in full view" *
          doctest::test_suite("slow")) {
  MarkerTally tally = look_from_all_sides({}, 1, int(scene_count(3)));
  CHECK(tally.expected >= int(enough(60)));
  MESSAGE(tally.summary());
}

TEST_CASE("OpenCV finds the markers through a sensor's noise and vignetting too" *
          doctest::test_suite("slow")) {
  ColorSensor sensor;
  sensor.read_noise = 0.004;
  sensor.shot_noise = 2e-4;
  sensor.vignetting = 1;
  MarkerTally tally = look_from_all_sides(sensor, 20, int(scene_count(2)));
  CHECK(tally.expected >= int(enough(40)));
  MESSAGE(tally.summary());
}

}  // namespace vantage::test
