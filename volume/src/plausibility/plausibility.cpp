#include "vantage/volume/plausibility.hpp"

#include "plausibility/checks.hpp"

namespace vantage {

std::vector<std::string> implausibilities(const WorldModel& world, const Box& work_area,
                                          double voxel_size_m) {
  using namespace volume::detail;
  const std::vector<Eigen::Vector3d> points = area_samples(work_area);
  std::vector<SampledCamera> cameras;
  for (const DepthCamera& camera : world.cameras) {
    cameras.push_back(
        {&camera, coverage_of(camera.camera, points), depth_samples(camera, work_area)});
  }
  Findings findings;
  check_views(cameras, work_area, findings);
  check_depths(cameras, voxel_size_m, findings);
  check_agreement(cameras, work_area, findings);
  check_objects(world, work_area, voxel_size_m, findings);
  return findings;
}

}  // namespace vantage
