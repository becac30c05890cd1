#include "plan/plan_shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan/shapes.hpp"
#include "vantage/volume/voxel_surface.hpp"

namespace vantage {
namespace {

const Eigen::Vector3f kOccupied(0.42f, 0.70f, 0.36f);
const Eigen::Vector3f kShadow(0.86f, 0.24f, 0.20f);
const Eigen::Vector3f kRevealed(0.16f, 0.76f, 0.82f);
const Eigen::Vector3f kGivenCamera(0.50f, 0.52f, 0.55f);
const Eigen::Vector3f kSuggestedCamera(0.90f, 0.08f, 0.06f);
const Eigen::Vector3f kWorkArea(0.35f, 0.37f, 0.40f);

/// How much of the light the revealed voxels keep back: one sees what stands inside them.
constexpr double kRevealedOpacity = 0.4;

TriangleMesh shape_of(const PinholeCamera& camera, const Plan& plan, double size = 1) {
  const double scale = size * scale_of(plan);
  const double distance = (camera.centre() - plan.request.work_area.centre()).norm();
  return camera_shape(camera, 0.22 * scale, 0.35 * size * distance, 0.006 * scale);
}

/// Many cameras are drawn small: else their frusta are all that one sees.
double size_among(std::size_t cameras) {
  return std::min(1.0, 2 / std::sqrt(double(std::max<std::size_t>(1, cameras))));
}

}  // namespace

double scale_of(const Plan& plan) {
  return 0.5 * plan.request.work_area.size().norm();
}

std::vector<PinholeCamera> suggested_cameras(const Plan& plan) {
  std::vector<PinholeCamera> cameras;
  for (const NextView& next : plan.views) {
    cameras.emplace_back(plan.request.intrinsics, next.view.T_world_cam, plan.request.range);
  }
  return cameras;
}

std::vector<ColoredMesh> voxel_meshes(const StateGrid& grid) {
  return {
      {"occupied", voxel_faces(grid, VoxelState::occupied), kOccupied},
      {"shadow", voxel_faces(grid, VoxelState::shadow), kShadow},
      {"revealed", voxel_faces(grid, VoxelState::revealed), kRevealed, float(kRevealedOpacity)}};
}

std::vector<ColoredMesh> camera_meshes(const Plan& plan, const WorldModel& world) {
  std::vector<ColoredMesh> meshes{
      {"work area", box_edges(plan.request.work_area, 0.004 * scale_of(plan)), kWorkArea}};
  for (const Observer& observer : world.cameras) {
    meshes.push_back({"camera " + observer.name,
                      shape_of(observer.camera, plan, size_among(world.cameras.size())),
                      kGivenCamera});
  }
  const std::vector<PinholeCamera> suggested = suggested_cameras(plan);
  for (std::size_t i = 0; i < suggested.size(); ++i) {
    meshes.push_back({i == 0 ? "suggested camera" : fmt::format("suggested camera {}", i + 1),
                      shape_of(suggested[i], plan, size_among(suggested.size())),
                      kSuggestedCamera});
  }
  return meshes;
}

}  // namespace vantage
