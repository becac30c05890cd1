#pragma once

#include <cstdint>
#include <memory>

#include "simulator/scene/simulated_scene.hpp"
#include "vantage/raycore/points.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/shadow_volume.hpp"
#include "vantage/volume/stereo_sensor.hpp"

namespace vantage {

/// What a view really gains in a simulated cell: the movable camera measures the true scene there,
/// its depth image joins the given ones, and the shadow that has become free or occupied counts.
///
/// One thread at a time; work is split over the caller's task arena.
class MeasuredGain {
 public:
  /// @param world that was planned for, with the given cameras and their depth images.
  /// @param planned what was taken for shadow.
  /// @param options by which `world` was classified.
  /// @param sensor of the movable camera; an ideal one measures all that it has in sight.
  MeasuredGain(const SimulatedScene& scene, const WorldModel& world, const StateGrid& planned,
               const VolumeOptions& options, const StereoSensor& sensor);

  /// Of the shadow that the views taken so far have left.
  /// @param seed of the sensor's noise.
  double gain_m3(const PinholeCamera& view, std::uint64_t seed);

  /// The same, and the view is taken: what comes after it gains from what it leaves.
  double take_m3(const PinholeCamera& view, std::uint64_t seed);

  /// What was taken for shadow and is still unknown. World frame, metres.
  const Points& left() const noexcept { return left_; }

 private:
  /// What a view leaves.
  Points left_after(const PinholeCamera& view, std::uint64_t seed, bool keep);
  double voxels_m3(std::size_t voxels) const;

  const SimulatedScene& scene_;
  GridGeometry geometry_;
  Points left_;
  StereoSensor sensor_;
  ShadowVolume volume_;
};

}  // namespace vantage
