#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include "simulator/color/lamp.hpp"
#include "simulator/color/sample_table.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/points.hpp"

namespace vantage {

/// Rays that are traced together: no more than a `Scene` traces without spreading them over tasks,
/// and few enough that all of their arrays stay in the processor's cache.
inline constexpr std::size_t kBlockRays = 512;

/// Room for a block of points or directions.
struct BlockPoints {
  float x[kBlockRays], y[kBlockRays], z[kBlockRays];

  PointsView view(std::size_t count) const { return {x, y, z, count}; }
  void set(std::size_t i, const Eigen::Vector3f& p) { x[i] = p.x(), y[i] = p.y(), z[i] = p.z(); }
  Eigen::Vector3f operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

/// A block of rays from the camera, and the surfaces that they have met: flat arrays, for the
/// kernels below.
struct RayBlock {
  std::size_t rays = 0;
  std::uint32_t pixel[kBlockRays];  ///< of the band
  BlockPoints direction;
  float lamp_x[kBlockRays], lamp_y[kBlockRays];  ///< as in LightSamples
  BlockPoints sky;
  Hits hits;

  std::size_t surfaces = 0;
  std::uint32_t ray[kBlockRays];  ///< that met the surface, in increasing order
  BlockPoints normal;             ///< on the camera's side
  BlockPoints from;               ///< where shadow rays start: a little above the surface
  float sky_light[kBlockRays], lamp_light[kBlockRays];

  BlockPoints to;  ///< where shadow rays end
  std::uint8_t hidden[kBlockRays];

  std::size_t lit = 0;  ///< surfaces that have light of the lamp if nothing hides it
  std::uint32_t lit_surface[kBlockRays];  ///< these
  BlockPoints lit_from, lit_to;
};

/// What a pixel's rays have in common.
struct PixelRays {
  Eigen::Vector3f sight;         ///< direction through its centre, world frame, depth 1
  Eigen::Vector3f per_u, per_v;  ///< how the direction changes per pixel
  LightSamples light;
};

/// Appends the samples `first` to `last` of a pixel as rays.
void add_rays(RayBlock& block, std::uint32_t pixel, const PixelRays& rays,
              const SampleTable& samples, std::size_t first, std::size_t last);

/// Lists the surfaces that `hits` has met, with their normals and where their shadow rays start.
void find_surfaces(RayBlock& block, const Eigen::Vector3f& camera_centre);

/// Fills `to` with the point in each surface's sky direction, `reach_m` away.
void aim_at_sky(RayBlock& block, float reach_m);

/// Fills `lit` and what follows for the surfaces that have `lamp_light` and whose point on the lamp
/// is above their horizon: the light leaves out what is below.
void aim_at_lamp(RayBlock& block, const Lamp& lamp);

}  // namespace vantage
