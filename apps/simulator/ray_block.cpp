#include "simulator/ray_block.hpp"

#include <cmath>

namespace vantage {

void aim_at_sky(RayBlock& block, float reach_m) {
  for (std::size_t s = 0; s < block.surfaces; ++s) {
    // Any two axes that make a frame with the normal, without a branch (Duff et al., "Building an
    // orthonormal basis, revisited", 2017).
    const float nx = block.normal.x[s], ny = block.normal.y[s], nz = block.normal.z[s];
    const float sign = std::copysign(1.0f, nz), a = -1 / (sign + nz), b = nx * ny * a;
    const LightSample& sample = block.sample[s];
    const float x = sample.sky_x * (1 + sign * nx * nx * a) + sample.sky_y * b + sample.sky_z * nx;
    const float y =
        sample.sky_x * sign * b + sample.sky_y * (sign + ny * ny * a) + sample.sky_z * ny;
    const float z = -sample.sky_x * sign * nx - sample.sky_y * ny + sample.sky_z * nz;
    block.to.x[s] = block.from.x[s] + reach_m * x;
    block.to.y[s] = block.from.y[s] + reach_m * y;
    block.to.z[s] = block.from.z[s] + reach_m * z;
  }
}

std::size_t aim_at_lamp(RayBlock& block, const Lamp& lamp) {
  std::size_t count = 0;
  for (std::size_t s = 0; s < block.surfaces; ++s) {
    if (!(block.lamp_light[s] > 0)) continue;
    const Eigen::Vector3f from = block.from[s];
    const Eigen::Vector3f to = lamp.at(block.sample[s].lamp.x, block.sample[s].lamp.y);
    if (!((to - from).dot(block.normal[s]) > 0)) continue;
    block.lit[count] = std::uint32_t(s);
    block.lamp_from.set(count, from);
    block.to.set(count, to);
    ++count;
  }
  return count;
}

}  // namespace vantage
