// One depth camera looks at a wall that hides half of a table: where should the next camera look
// from?
#include <cstdio>
#include <vantage/planner/plan.hpp>
#include <vantage/raycore/advanced/scene_builder.hpp>

namespace {

/// Stands in for a sensor: the depth of the first surface behind each pixel.
std::shared_ptr<vantage::DepthImage> measure(const vantage::Scene& scene,
                                             const vantage::PinholeCamera& camera) {
  const vantage::Intrinsics& k = camera.intrinsics();
  auto depth = std::make_shared<vantage::DepthImage>(k.width, k.height);  // all unknown
  for (int v = 0; v < k.height; ++v) {
    for (int u = 0; u < k.width; ++u) {
      const vantage::PixelRay ray = camera.pixel_ray(u, v);
      const auto hit = scene.closest_hit({ray.origin.cast<float>(), ray.direction.cast<float>()});
      if (hit) depth->set(u, v, hit->t);  // t is the depth along the optical axis
    }
  }
  return depth;
}

}  // namespace

int main() {
  vantage::SceneBuilder cell;
  cell.add_box({{-1.0, -1.0, -0.05}, {1.0, 1.0, 0.0}});  // the table
  cell.add_box({{-0.2, -0.02, 0.0}, {0.2, 0.02, 0.2}});  // the wall

  const vantage::Intrinsics intrinsics{320, 240, 300, 300, 159.5, 119.5};
  const vantage::PinholeCamera camera(intrinsics,
                                      vantage::Pose::looking_at({0, -0.8, 0.5}, {0, 0, 0.1}));
  const auto depth = measure(*cell.build(), camera);

  vantage::WorldModel world;
  world.cameras.push_back({"front", camera, depth});
  const vantage::Plan plan = vantage::plan_next_view(
      world, {.work_area = {{-0.3, -0.3, 0}, {0.3, 0.3, 0.3}}, .intrinsics = intrinsics});
  const vantage::RankedView* best = plan.best();
  if (best == nullptr) return 4;  // nothing is hidden, or no candidate is allowed

  const Eigen::Vector3d eye = best->T_world_cam.translation();
  const std::uint64_t shadow = plan.classified->count(vantage::VoxelState::shadow);
  std::printf("look from (%.2f, %.2f, %.2f) m: reveals %.1f of %.1f litres\n", eye.x(), eye.y(),
              eye.z(), 1e3 * plan.volume_m3(*best->revealed_voxels), 1e3 * plan.volume_m3(shadow));
}
