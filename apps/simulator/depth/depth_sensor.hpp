#pragma once

#include <cstdint>

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/depth_image.hpp"
#include "vantage/volume/stereo_sensor.hpp"

namespace vantage {

/// What a stereo camera measures of a scene. The first imager is the given camera (its centre,
/// intrinsics and depth range); the second one stands `noise.baseline_m` along its x axis and looks
/// the same way with the same intrinsics.
///
/// Noise hashes (seed, pixel): the same call gives the same bits at any number of threads. Runs in
/// the caller's task arena.
/// @throws Error as `StereoSensor::check` and `Scene::render_depth` do.
DepthImage simulate_depth(const Scene& scene, const PinholeCamera& camera,
                          const StereoSensor& sensor, std::uint64_t seed);

}  // namespace vantage
