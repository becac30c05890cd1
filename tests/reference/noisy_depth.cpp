#include "reference/noisy_depth.hpp"

#include <cmath>

#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage::test {

std::shared_ptr<const DepthImage> noisy_depth(const Scene& scene, const PinholeCamera& camera,
                                              Random& random) {
  DepthImage depth = scene.render_depth(camera);
  const int hole_u = int(random.below(std::uint32_t(depth.width())));
  const int hole_v = int(random.below(std::uint32_t(depth.height())));
  for (int v = 0; v < depth.height(); ++v) {
    for (int u = 0; u < depth.width(); ++u) {
      const double z = double(depth.at(u, v));
      const double noise = random.uniform(-1, 1) * 0.004 * z * z;
      const bool hole = random.below(20) == 0 || (std::abs(u - hole_u) < 6 && v > hole_v);
      depth.set(u, v, hole ? DepthImage::kUnknown : float(z + noise));
    }
  }
  return std::make_shared<const DepthImage>(std::move(depth));
}

std::shared_ptr<const Scene> scene_with_foreign_box(const WorldModel& world, Random& random) {
  SceneBuilder builder;
  for (const auto* list : {&world.objects, &world.static_structures}) {
    for (const KnownObject& object : *list) {
      builder.add_mesh(object.mesh->transformed(object.T_world_object));
    }
  }
  const Pose T_world_box = Pose::from_translation({0, 0, 0.1}) * random.pose(0.08);
  builder.add_box(Box({-0.03, -0.02, -0.04}, {0.03, 0.02, 0.04}), T_world_box);
  builder.add_box(Box({-1, -1, -0.1}, {1, 1, 0}));
  return builder.build();
}

PinholeCamera random_observer(Random& random) {
  Eigen::Vector3d direction = random.direction();
  direction.z() = std::abs(direction.z());
  const Eigen::Vector3d target = Eigen::Vector3d(0, 0, 0.08) + random.in_cube(0.05);
  const Eigen::Vector3d eye = target + random.uniform(0.3, 0.6) * direction;
  const double focal = random.uniform(50, 200);
  return {{81, 63, focal, focal, 40.2, 30.7}, Pose::looking_at(eye, target), {0.1, 1.5}};
}

}  // namespace vantage::test
