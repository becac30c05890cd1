#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "simulator/lamp.hpp"
#include "simulator/sample_table.hpp"
#include "vantage/raycore/points.hpp"
#include "vantage/raycore/scene.hpp"

namespace vantage {

/// Rays that are traced together: as many as a `Scene` traces without spreading them over tasks,
/// and few enough to stay in the processor's cache.
inline constexpr std::size_t kBlockRays = 1024;

/// Room for a block of points or directions.
struct BlockPoints {
  float x[kBlockRays], y[kBlockRays], z[kBlockRays];

  PointsView view(std::size_t count) const { return {x, y, z, count}; }
  void set(std::size_t i, const Eigen::Vector3f& p) { x[i] = p.x(), y[i] = p.y(), z[i] = p.z(); }
  Eigen::Vector3f operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// A block of rays from the camera, and the surfaces that they have met: flat arrays.
struct RayBlock {
  std::size_t rays = 0;
  BlockPoints direction;
  Hits hits;

  std::size_t surfaces = 0;
  std::uint32_t pixel[kBlockRays];  ///< of the band
  LightSample sample[kBlockRays];
  Eigen::Vector3f color[kBlockRays];  ///< linear
  BlockPoints normal;                 ///< on the camera's side
  BlockPoints from;                   ///< where shadow rays start: a little above the surface
  float light[kBlockRays];            ///< on the surface
  float lamp_light[kBlockRays];       ///< of the lamp alone

  BlockPoints to;  ///< where shadow rays end
  std::uint8_t hidden[kBlockRays];

  std::uint32_t lit[kBlockRays];  ///< surfaces that get light from the lamp unless it is hidden
  BlockPoints lamp_from;
};

/// Fills `to` with the point in each surface's sky direction, `reach_m` away.
void aim_at_sky(RayBlock& block, float reach_m);

/// Fills `lit`, `lamp_from` and `to` for the surfaces that have `lamp_light` and see their point of
/// the lamp above their horizon; the light leaves out what is below.
/// @returns how many these are.
std::size_t aim_at_lamp(RayBlock& block, const Lamp& lamp);

}  // namespace vantage
