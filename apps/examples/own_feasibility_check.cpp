// Where the robot can bring the camera is known to the robot alone: it is asked for every
// candidate, every servo step and every polished pose, and what it rejects has its reason in the
// plan.
#include <cstdio>
#include <optional>
#include <string>
#include <vantage/planner/plan.hpp>

namespace {

/// Stands in for the robot's kinematics: an arm at the table's edge with a reach of 0.9 m, and a
/// safety fence at x = 0.3 m. Called by several threads at once.
std::optional<std::string> ask_robot(const vantage::Pose& T_world_cam) {
  const Eigen::Vector3d& eye = T_world_cam.translation();
  if (eye.x() > 0.3) return "behind the safety fence";
  if ((eye - Eigen::Vector3d(0, -0.5, 0.2)).norm() > 0.9) return "no inverse kinematics";
  return std::nullopt;
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
                                      .constraints = {.checks = {ask_robot}}});

  for (const auto& [reason, count] : vantage::rejections_of(plan)) {
    std::printf("%zu of %zu candidates: %s\n", count, plan.candidates.size(), reason.c_str());
  }
  if (plan.best() == nullptr) return 4;
  const Eigen::Vector3d eye = plan.best()->T_world_cam.translation();
  std::printf("look from (%.2f, %.2f, %.2f) m\n", eye.x(), eye.y(), eye.z());
}
