#include "demo_scene.hpp"

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
  // Five side by side, three on top: a wall along x with a step at each end.
  for (int i = 0; i < 8; ++i) {
    const bool upper = i >= 5;
    const double x = kCube * (upper ? i - 6 : i - 2), z = kCube * (upper ? 1.5 : 0.5);
    world.objects.push_back(
        {"cube " + std::to_string(i), cube, Pose::from_translation({x, 0.02, z})});
  }
  world.cameras.push_back(
      {"side", PinholeCamera(kCamera, Pose::looking_at({0.1, -0.6, 0.28}, {0, 0, 0.04}), kRange),
       nullptr});
  return world;
}

PlanRequest demo_request() {
  return {.work_area = Box({-0.25, -0.175, 0}, {0.25, 0.175, 0.2}),
          .intrinsics = kCamera,
          .range = kRange};
}

}  // namespace vantage
