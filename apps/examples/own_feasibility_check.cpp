// Where the robot can bring the camera is known to the robot alone: its answers, sampled once, are
// a map of reachable positions, and views elsewhere are rejected with that as the reason.
#include <cstdio>
#include <map>
#include <vantage/planner/plan.hpp>

namespace {

/// Stands in for the robot's kinematics: an arm at the table's edge with a reach of 0.9 m that does
/// not go behind a safety fence at x = 0.3 m.
bool robot_reaches(const Eigen::Vector3d& p_world) {
  return (p_world - Eigen::Vector3d(0, -0.5, 0.2)).norm() < 0.9 && p_world.x() < 0.3;
}

std::shared_ptr<const vantage::ReachMap> sampled_reach() {
  auto map = std::make_shared<vantage::ReachMap>();
  map->origin_m = {-1.0, -1.5, 0.0};
  map->cell_m = 0.05;
  map->size = {40, 40, 24};
  for (int i = 0; i < map->size.x(); ++i) {
    for (int j = 0; j < map->size.y(); ++j) {
      for (int k = 0; k < map->size.z(); ++k) {
        const Eigen::Vector3d centre = Eigen::Vector3d(i + 0.5, j + 0.5, k + 0.5) * map->cell_m;
        map->reachable.push_back(robot_reaches(map->origin_m + centre));
      }
    }
  }
  return map;
}

}  // namespace

int main() {
  const vantage::Intrinsics intrinsics{320, 240, 300, 300, 159.5, 119.5};
  const auto wall = std::make_shared<const vantage::TriangleMesh>(
      vantage::TriangleMesh::from_box({{-0.2, -0.02, 0}, {0.2, 0.02, 0.2}}));
  vantage::WorldModel world;
  world.objects.push_back({"wall", wall, {}});
  world.cameras.push_back(
      {"front",
       vantage::PinholeCamera(intrinsics, vantage::Pose::looking_at({0, -0.8, 0.5}, {0, 0, 0.1})),
       nullptr});
  const vantage::Plan plan =
      vantage::plan_next_view(world, {.work_area = {{-0.3, -0.3, 0}, {0.3, 0.3, 0.3}},
                                      .intrinsics = intrinsics,
                                      .constraints = {.reach_map = sampled_reach()}});

  std::map<std::string_view, int> rejected;
  for (const auto& candidate : plan.candidates) {
    if (candidate.rejected != vantage::InvalidReason::none) {
      ++rejected[vantage::to_text(candidate.rejected)];
    }
  }
  for (const auto& [reason, count] : rejected) {
    std::printf("%d of %zu candidates: %s\n", count, plan.candidates.size(), reason.data());
  }
  if (plan.best() == nullptr) return 4;
  const Eigen::Vector3d eye = plan.best()->T_world_cam.translation();
  std::printf("look from (%.2f, %.2f, %.2f) m\n", eye.x(), eye.y(), eye.z());
}
