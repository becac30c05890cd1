#include "reference/random_workcell.hpp"

#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage::test {
namespace {

std::shared_ptr<const TriangleMesh> random_box_mesh(Random& random) {
  const Eigen::Vector3d half(random.uniform(0.02, 0.06), random.uniform(0.02, 0.06),
                             random.uniform(0.02, 0.06));
  return std::make_shared<const TriangleMesh>(TriangleMesh::from_box(Box(-half, half)));
}

Pose random_pose(Random& random) {
  const Pose turned = random.pose(0.08);
  return Pose::from_translation({0, 0, 0.1}) * turned;
}

std::shared_ptr<const DepthImage> with_holes(DepthImage depth, Random& random) {
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      if (random.below(10) == 0) depth.set(u, v, DepthImage::kUnknown);
    }
  }
  return std::make_shared<const DepthImage>(std::move(depth));
}

}  // namespace

Box random_workcell_area() {
  return Box({-0.12, -0.12, 0}, {0.12, 0.12, 0.2});
}

WorldModel random_workcell(std::uint32_t seed, bool all_measure) {
  Random random(seed);
  WorldModel world;
  const std::uint32_t boxes = 1 + random.below(4);
  for (std::uint32_t i = 0; i < boxes; ++i) {
    world.objects.push_back(
        {"box " + std::to_string(i), random_box_mesh(random), random_pose(random)});
  }
  if (random.below(2) == 0) {
    const auto sphere = std::make_shared<const TriangleMesh>(icosphere(0.05, 2));
    world.static_structures.push_back({"sphere", sphere, random_pose(random)});
  }

  SceneBuilder truth;  // with a box that the world model does not know
  for (const KnownObject& object : world.objects) {
    truth.add_mesh(object.mesh->transformed(object.T_world_object));
  }
  for (const KnownObject& object : world.static_structures) {
    truth.add_mesh(object.mesh->transformed(object.T_world_object));
  }
  truth.add_mesh(random_box_mesh(random)->transformed(random_pose(random)));
  truth.add_box(Box({-1, -1, -0.1}, {1, 1, 0}));
  const std::shared_ptr<const Scene> scene = truth.build();

  const std::uint32_t cameras = 1 + random.below(3);
  for (std::uint32_t i = 0; i < cameras; ++i) {
    Eigen::Vector3d direction = random.direction();
    direction.z() = std::abs(direction.z());
    const Eigen::Vector3d target(random.uniform(-0.05, 0.05), random.uniform(-0.05, 0.05), 0.08);
    const PinholeCamera camera(
        {61, 47, random.uniform(50, 120), random.uniform(50, 120), 30.2, 23.7},
        Pose::looking_at(target + random.uniform(0.3, 0.6) * direction, target), {0.1, 1.5});
    const bool measures = random.below(2) == 0 || all_measure;
    world.cameras.push_back({std::to_string(i), camera,
                             measures ? with_holes(scene->render_depth(camera), random) : nullptr});
  }
  return world;
}

}  // namespace vantage::test
