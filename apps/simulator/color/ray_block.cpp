#include "simulator/color/ray_block.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage {
namespace {

// Keeps shadow rays off the surface that they start on: a part of the distance to the camera.
constexpr float kLift = 1e-4f, kMinDistance = 0.1f;

/// Calls `copy(surface, ray)` for each surface; mostly every ray has met one.
template <class Copy>
[[gnu::always_inline]] inline void for_each_surface(const RayBlock& block, const Copy& copy) {
  if (block.surfaces == block.rays) {
    for (std::size_t i = 0; i < block.rays; ++i) copy(i, i);
  } else {
    for (std::size_t s = 0; s < block.surfaces; ++s) copy(s, std::size_t(block.ray[s]));
  }
}

[[gnu::always_inline]] inline void add_rays_body(RayBlock& block, std::uint32_t pixel,
                                                 const PixelRays& rays, const SampleTable& samples,
                                                 std::size_t first, std::size_t last) {
  const float sx = rays.sight.x(), sy = rays.sight.y(), sz = rays.sight.z();
  const float ux = rays.per_u.x(), uy = rays.per_u.y(), uz = rays.per_u.z();
  const float vx = rays.per_v.x(), vy = rays.per_v.y(), vz = rays.per_v.z();
  const float *du = samples.position_x(), *dv = samples.position_y();
  const LightSamples& light = rays.light;
  std::size_t i = block.rays;
  for (std::size_t s = first; s < last; ++s, ++i) {
    block.pixel[i] = pixel;
    block.direction.x[i] = sx + du[s] * ux + dv[s] * vx;
    block.direction.y[i] = sy + du[s] * uy + dv[s] * vy;
    block.direction.z[i] = sz + du[s] * uz + dv[s] * vz;
    block.lamp_x[i] = light.lamp_x[s], block.lamp_y[i] = light.lamp_y[s];
    block.sky.x[i] = light.sky_x[s], block.sky.y[i] = light.sky_y[s];
    block.sky.z[i] = light.sky_z[s];
  }
  block.rays = i;
}
constexpr Multiversion<add_rays_body> add_rays_kernel;

[[gnu::always_inline]] inline void find_surfaces_body(RayBlock& block,
                                                      const Eigen::Vector3f& camera_centre) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < block.rays; ++i) {
    block.ray[count] = std::uint32_t(i);
    count += block.hits.hit(i);
  }
  block.surfaces = count;
  const float cx = camera_centre.x(), cy = camera_centre.y(), cz = camera_centre.z();
  const float* t = block.hits.t.data();
  const PointsView normal = block.hits.normal;
  for_each_surface(block, [&](std::size_t s, std::size_t i) {
    const float x = block.direction.x[i], y = block.direction.y[i], z = block.direction.z[i];
    const float towards = x * normal.x[i] + y * normal.y[i] + z * normal.z[i];
    const float side = towards > 0 ? -1.0f : 1.0f;
    const float nx = side * normal.x[i], ny = side * normal.y[i], nz = side * normal.z[i];
    const float lift = kLift * std::max(kMinDistance, t[i]);
    block.normal.x[s] = nx, block.normal.y[s] = ny, block.normal.z[s] = nz;
    block.from.x[s] = cx + t[i] * x + lift * nx;
    block.from.y[s] = cy + t[i] * y + lift * ny;
    block.from.z[s] = cz + t[i] * z + lift * nz;
  });
}
constexpr Multiversion<find_surfaces_body> find_surfaces_kernel;

[[gnu::always_inline]] inline void aim_at_sky_body(RayBlock& block, float reach_m) {
  for_each_surface(block, [&](std::size_t s, std::size_t i) {
    // Any two axes that make a frame with the normal, without a branch (Duff et al., "Building an
    // orthonormal basis, revisited", 2017).
    const float nx = block.normal.x[s], ny = block.normal.y[s], nz = block.normal.z[s];
    const float sign = std::copysign(1.0f, nz), a = -1 / (sign + nz), b = nx * ny * a;
    const float sx = block.sky.x[i], sy = block.sky.y[i], sz = block.sky.z[i];
    const float x = sx * (1 + sign * nx * nx * a) + sy * b + sz * nx;
    const float y = sx * sign * b + sy * (sign + ny * ny * a) + sz * ny;
    const float z = -sx * sign * nx - sy * ny + sz * nz;
    block.to.x[s] = block.from.x[s] + reach_m * x;
    block.to.y[s] = block.from.y[s] + reach_m * y;
    block.to.z[s] = block.from.z[s] + reach_m * z;
  });
}
constexpr Multiversion<aim_at_sky_body> aim_at_sky_kernel;

[[gnu::always_inline]] inline void aim_at_lamp_body(RayBlock& block, const Lamp& lamp) {
  const Eigen::Vector3f &c = lamp.centre(), &x = lamp.side_x(), &y = lamp.side_y();
  float above[kBlockRays];
  for_each_surface(block, [&](std::size_t s, std::size_t i) {
    const float lx = block.lamp_x[i], ly = block.lamp_y[i];
    block.to.x[s] = c.x() + lx * x.x() + ly * y.x();
    block.to.y[s] = c.y() + lx * x.y() + ly * y.y();
    block.to.z[s] = c.z() + lx * x.z() + ly * y.z();
    above[s] = (block.to.x[s] - block.from.x[s]) * block.normal.x[s] +
               (block.to.y[s] - block.from.y[s]) * block.normal.y[s] +
               (block.to.z[s] - block.from.z[s]) * block.normal.z[s];
  });
  std::size_t count = 0;
  for (std::size_t s = 0; s < block.surfaces; ++s) {
    block.lit_surface[count] = std::uint32_t(s);
    block.lit_from.set(count, block.from[s]);
    block.lit_to.set(count, block.to[s]);
    count += (above[s] > 0) & (block.lamp_light[s] > 0);
  }
  block.lit = count;
}
constexpr Multiversion<aim_at_lamp_body> aim_at_lamp_kernel;

}  // namespace

void add_rays(RayBlock& block, std::uint32_t pixel, const PixelRays& rays,
              const SampleTable& samples, std::size_t first, std::size_t last) {
  add_rays_kernel(block, pixel, rays, samples, first, last);
}

void find_surfaces(RayBlock& block, const Eigen::Vector3f& camera_centre) {
  find_surfaces_kernel(block, camera_centre);
}

void aim_at_sky(RayBlock& block, float reach_m) {
  aim_at_sky_kernel(block, reach_m);
}

void aim_at_lamp(RayBlock& block, const Lamp& lamp) {
  aim_at_lamp_kernel(block, lamp);
}

}  // namespace vantage
