#include "evaluate/expected_gain/measured_gain.hpp"

#include "simulator/depth/depth_sensor.hpp"

namespace vantage {
namespace {

/// Points that are not in the line of sight of an ideal camera.
Points out_of_sight(const Points& points, const Scene& scene, const PinholeCamera& view) {
  std::vector<std::uint8_t> in_view(points.size()), blocked(points.size());
  view.in_view(points, in_view);
  scene.occluded(points, view.centre().cast<float>(), blocked);
  Points left;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (in_view[i] == 0 || blocked[i] != 0) left.push_back(points[i]);
  }
  return left;
}

Points still_shadow(const Points& points, const StateGrid& grid) {
  Points left;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto voxel = grid.geometry().voxel_at(points[i].cast<double>());
    if (voxel && grid.at(*voxel) == VoxelState::shadow) left.push_back(points[i]);
  }
  return left;
}

}  // namespace

MeasuredGain::MeasuredGain(const SimulatedScene& scene, const WorldModel& world,
                           const StateGrid& planned, const VolumeOptions& options,
                           const StereoSensor& sensor)
    : scene_(scene),
      geometry_(planned.geometry()),
      left_(planned.centres(VoxelState::shadow)),
      sensor_(sensor),
      volume_(world, geometry_, options) {}

double MeasuredGain::gain_m3(const PinholeCamera& view, std::uint64_t seed) {
  return voxels_m3(left_.size() - left_after(view, seed, false).size());
}

double MeasuredGain::take_m3(const PinholeCamera& view, std::uint64_t seed) {
  const std::size_t before = left_.size();
  left_ = left_after(view, seed, true);
  return voxels_m3(before - left_.size());
}

Points MeasuredGain::left_after(const PinholeCamera& view, std::uint64_t seed, bool keep) {
  if (sensor_ == StereoSensor::ideal()) return out_of_sight(left_, scene_.rays(), view);
  const auto depth =
      std::make_shared<const DepthImage>(simulate_depth(scene_.rays(), view, sensor_, seed));
  const std::size_t camera = volume_.add_camera({"view", view, depth});
  Points left = still_shadow(left_, *volume_.grid());
  if (!keep) volume_.remove_camera(camera);
  return left;
}

double MeasuredGain::voxels_m3(std::size_t voxels) const {
  return double(voxels) * geometry_.voxel_volume_m3();
}

}  // namespace vantage
