#include "bench_planner_scenes.hpp"

#include <Eigen/Geometry>

#include "bench_volume_scenes.hpp"
#include "reference/random_boxes.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage::bench {
namespace {

const Intrinsics kImage{640, 480, 600, 600, 319.5, 239.5};
const DepthRange kRange{0.1, 3};

PlannerScene make_scene(const std::string& name, const std::vector<test::TurnedBox>& boxes,
                        const std::vector<PinholeCamera>& cameras, double voxel_size_m,
                        OccluderMode mode) {
  WorldModel world;
  for (const test::TurnedBox& box : boxes) {
    world.objects.push_back(test::known_box("box " + std::to_string(world.objects.size()), box));
  }
  for (const PinholeCamera& camera : cameras) world.cameras.push_back({"camera", camera, nullptr});
  const VolumeOptions options{.occluders = mode};
  const auto grid = classify(world, GridGeometry::covering(wall_area(), voxel_size_m), options);
  return {name,
          world,
          wall_area(),
          boxes,
          grid,
          PlanningScene(world, grid, mode),
          PinholeCamera(kImage, {}, kRange)};
}

std::vector<PinholeCamera> cameras_at(const std::vector<Eigen::Vector3d>& eyes) {
  std::vector<PinholeCamera> cameras;
  for (const Eigen::Vector3d& eye : eyes) {
    cameras.emplace_back(kImage, Pose::looking_at(eye, {0, 0, 0.1}), kRange);
  }
  return cameras;
}

test::TurnedBox box_at(const Eigen::Vector3d& centre, const Eigen::Vector3d& size, double angle) {
  return {0.5 * size,
          Pose::from_rotation(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix(),
                              centre)};
}

}  // namespace

std::vector<PinholeCamera> PlannerScene::views(const CandidateSet& set) const {
  std::vector<PinholeCamera> views;
  for (const ViewCandidate& candidate : view_candidates(set, area)) {
    views.push_back(camera.moved_to(candidate.T_world_cam));
  }
  return views;
}

PlannerScene wall_scene(double voxel_size_m, OccluderMode mode) {
  const Wall cubes = wall();
  return make_scene("wall", cubes.cubes, cubes.cameras, voxel_size_m, mode);
}

PlannerScene two_pillars_scene(double voxel_size_m, OccluderMode mode) {
  return make_scene("two pillars",
                    {box_at({-0.04, -0.05, 0.1}, {0.06, 0.06, 0.2}, 0.3),
                     box_at({0.05, 0.06, 0.1}, {0.06, 0.06, 0.2}, -0.2)},
                    cameras_at({{0.05, -0.75, 0.35}, {0.8, 0.1, 0.4}}), voxel_size_m, mode);
}

PlannerScene corridor_scene(double voxel_size_m, OccluderMode mode) {
  return make_scene("corridor",
                    {box_at({0, -0.05, 0.06}, {0.3, 0.03, 0.12}, 0.1),
                     box_at({-0.01, 0.05, 0.06}, {0.3, 0.03, 0.12}, 0.1),
                     box_at({0.03, 0, 0.02}, {0.04, 0.04, 0.04}, 0.4)},
                    cameras_at({{0.05, -0.8, 0.35}, {-0.1, 0.75, 0.4}}), voxel_size_m, mode);
}

std::vector<std::vector<PinholeCamera>> sites(const std::vector<PinholeCamera>& views) {
  std::vector<std::vector<PinholeCamera>> result;
  for (const PinholeCamera& view : views) {
    if (result.empty() || result.back().back().centre() != view.centre()) result.emplace_back();
    result.back().push_back(view);
  }
  return result;
}

}  // namespace vantage::bench
