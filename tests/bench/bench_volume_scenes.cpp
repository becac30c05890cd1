#include "bench_volume_scenes.hpp"

#include <Eigen/Geometry>
#include <string>

#include "reference/noisy_depth.hpp"
#include "reference/random_boxes.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage::bench {
namespace {

const Intrinsics kImage{640, 480, 600, 600, 319.5, 239.5};

Pose turned_about_z(double angle, const Eigen::Vector3d& centre) {
  return Pose::from_rotation(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
                             centre);
}

/// What is really there: boxes on a floor.
std::shared_ptr<const Scene> scene_of(const std::vector<test::TurnedBox>& boxes) {
  SceneBuilder builder;
  for (const test::TurnedBox& box : boxes) {
    builder.add_box(Box(-box.half, box.half), box.T_world_box);
  }
  builder.add_box(Box({-3, -3, -0.1}, {3, 3, 0}));
  return builder.build();
}

std::vector<test::TurnedBox> boxes_on_table(std::size_t count) {
  test::Random random(1);
  std::vector<test::TurnedBox> boxes;
  while (boxes.size() < count) {
    const Eigen::Vector3d half(random.uniform(0.03, 0.12), random.uniform(0.03, 0.12),
                               random.uniform(0.03, 0.2));
    const Eigen::Vector3d centre(random.uniform(-0.85, 0.85), random.uniform(-0.85, 0.85),
                                 half.z());
    boxes.push_back({half, turned_about_z(random.uniform(0, 3), centre)});
  }
  return boxes;
}

std::vector<PinholeCamera> corner_cameras() {
  std::vector<PinholeCamera> cameras;
  for (const double x : {-1.3, 1.3}) {
    for (const double y : {-1.4, 1.4}) {
      cameras.emplace_back(kImage, Pose::looking_at({x, y, 1.3}, {0, 0, 0.1}), DepthRange{0.2, 4});
    }
  }
  return cameras;
}

KnownObject table() {
  return {
      "table",
      std::make_shared<const TriangleMesh>(TriangleMesh::from_box(Box({-1, -1, -0.05}, {1, 1, 0}))),
      {}};
}

}  // namespace

Box wall_area() {
  return Box({-0.25, -0.175, 0}, {0.25, 0.175, 0.3});
}

Wall wall() {
  const Pose T_world_wall = turned_about_z(0.21, {0.013, 0.007, 0});
  Wall result;
  for (const Eigen::Vector3d& centre :
       {Eigen::Vector3d(-0.055, 0, 0.025), Eigen::Vector3d(0, 0, 0.025),
        Eigen::Vector3d(0.055, 0, 0.025), Eigen::Vector3d(0, 0, 0.075),
        Eigen::Vector3d(0, 0.075, 0.025)}) {
    result.cubes.push_back(
        {Eigen::Vector3d::Constant(0.025), T_world_wall * Pose::from_translation(centre)});
  }
  for (const Eigen::Vector3d& eye :
       {Eigen::Vector3d(0.05, -0.75, 0.35), Eigen::Vector3d(0.85, 0.1, 0.4)}) {
    result.cameras.emplace_back(kImage, Pose::looking_at(eye, {0, 0, 0.1}), DepthRange{0.1, 3});
  }
  return result;
}

WorldModel Wall::model() const {
  WorldModel world;
  for (const test::TurnedBox& cube : cubes) {
    world.objects.push_back(test::known_box("cube " + std::to_string(world.objects.size()), cube));
  }
  for (const PinholeCamera& camera : cameras) world.cameras.push_back({"camera", camera, nullptr});
  return world;
}

std::vector<char> Wall::solid(const GridGeometry& geometry) const {
  bool close_call = false;  // of no interest: nothing is compared voxel by voxel here
  return test::solid_voxels(cubes, geometry, close_call);
}

WallFrames wall_frames(bool known) {
  const Wall cubes = wall();
  const auto truth = scene_of(cubes.cubes);
  test::Random random(2);
  WallFrames result{cubes.model(), {}};
  if (!known) result.world.objects.clear();
  result.world.cameras.resize(1, result.world.cameras[0]);
  for (int i = 0; i < 4; ++i) {
    result.frames.push_back(test::noisy_depth(*truth, cubes.cameras[0], random));
  }
  result.world.cameras[0].depth = result.frames[0];
  return result;
}

Box cell_area() {
  return Box({-1, -1, 0}, {1, 1, 1});
}

WorldModel cell() {
  const std::vector<test::TurnedBox> boxes = boxes_on_table(30);
  const auto truth = scene_of(boxes);
  WorldModel world;
  world.static_structures.push_back(table());
  for (std::size_t i = 0; i < 20; ++i) {
    world.objects.push_back(test::known_box("box " + std::to_string(i), boxes[i]));
  }
  test::Random random(3);
  for (const PinholeCamera& camera : corner_cameras()) {
    world.cameras.push_back({"corner", camera, test::noisy_depth(*truth, camera, random)});
  }
  return world;
}

WorldModel many_objects() {
  const auto sphere = std::make_shared<const TriangleMesh>(test::icosphere(0.03, 5));
  test::Random random(4);
  WorldModel world;
  for (int i = 0; i < 500; ++i) {
    const Pose turned = random.pose(0.9);
    const Eigen::Vector3d centre(turned.translation().x(), turned.translation().y(),
                                 random.uniform(0.03, 0.5));
    const Pose pose = Pose::from_rotation(turned.rotation(), centre);
    world.objects.push_back({"ball " + std::to_string(i), sphere, pose});
  }
  for (const PinholeCamera& camera : corner_cameras()) {
    world.cameras.push_back({"corner", camera, nullptr});
  }
  return world;
}

}  // namespace vantage::bench
