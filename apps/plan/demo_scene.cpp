#include "plan/demo_scene.hpp"

namespace vantage {
namespace {

constexpr double kCube = 0.05;

// An Intel RealSense D435's colour stream at 640 × 480, rounded.
constexpr Intrinsics kCamera{640, 480, 615, 615, 319.5, 239.5};
constexpr DepthRange kRange{0.1, 3.0};

}  // namespace

WorldModel demo_world() {
  WorldModel world;
  const auto cube = std::make_shared<const TriangleMesh>(TriangleMesh::from_box(
      Box(Eigen::Vector3d::Constant(-kCube / 2), Eigen::Vector3d::Constant(kCube / 2))));
  const auto add_cube = [&](double x, double y, int row) {
    world.objects.push_back({"cube " + std::to_string(world.objects.size()), cube,
                             Pose::from_translation({x, y, kCube * (row + 0.5)})});
  };
  // Five, four and three cubes on each other, each row 2 cm further back, and a low second wall
  // behind: no single view reveals all that lies under the overhang and between the two.
  for (int row = 0; row < 3; ++row) {
    for (int i = 0; i < 5 - row; ++i) {
      add_cube(kCube * (i - 0.5 * (4 - row)), 0.02 * row, row);
    }
  }
  for (int i = 0; i < 3; ++i) add_cube(kCube * (i - 1.5), 0.1, 0);
  world.cameras.push_back(
      {"side", PinholeCamera(kCamera, Pose::looking_at({0.1, -0.65, 0.26}, {0, 0, 0.07}), kRange),
       nullptr});
  return world;
}

PlanRequest demo_request() {
  return {.work_area = Box({-0.25, -0.175, 0}, {0.25, 0.175, 0.2}),
          .intrinsics = kCamera,
          .range = kRange};
}

}  // namespace vantage
