#pragma once

#include <cmath>
#include <limits>

#include "scene/hit_packet.hpp"
#include "unobserved/seen_walk.hpp"

// How a surface that Embree has met in a lattice's projective space looks at the lattice's camera.

namespace vantage::detail {

/// Turns the hits' normals into those of the planes in the world, of any length, and n_c into
/// their distance from the lattice's camera times that length.
[[gnu::always_inline]] inline void turn_normals(const WalkVolume& volume, RTCRayHit16& packet,
                                                float* n_c) {
  const float* m = volume.probe.m;
  const float height = volume.probe.probe->height;
  const RTCRay16& ray = packet.ray;
  RTCHit16& hit = packet.hit;
  make_unit(hit.Ng_x, hit.Ng_y, hit.Ng_z);  // NaN where there is no hit
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    // The plane is a u + b v + c w + d = 0. Times z that is a (u z) + b (v z) + d z = -c · (w z).
    const float a = hit.Ng_x[i], b = hit.Ng_y[i], c = hit.Ng_z[i], s = ray.tfar[i];
    const float d =
        -(a * (ray.org_x[i] + s * ray.dir_x[i]) + b * (ray.org_y[i] + s * ray.dir_y[i]) +
          c * (ray.org_z[i] + s * ray.dir_z[i]));
    hit.Ng_x[i] = a * m[0] + b * m[3] + d * m[6];
    hit.Ng_y[i] = a * m[1] + b * m[4] + d * m[7];
    hit.Ng_z[i] = a * m[2] + b * m[5] + d * m[8];
    n_c[i] = std::fabs(c) * height;
  }
}

/// How the surface at the hits looks at the lattice's camera.
[[gnu::always_inline]] inline void store_facing(const WalkVolume& volume, const float* dir_x,
                                                const float* dir_y, const float* dir_z,
                                                const float* t, const int* hits,
                                                RTCRayHit16& packet, float* facing) {
  alignas(64) float distance[kPacketWidth], normal[kPacketWidth], reach[kPacketWidth];
  turn_normals(volume, packet, distance);
  const RTCHit16& hit = packet.hit;
  const float ax = volume.apex[0], ay = volume.apex[1], az = volume.apex[2];
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float s = t[i], nx = hit.Ng_x[i], ny = hit.Ng_y[i], nz = hit.Ng_z[i];
    const float x = ax - s * dir_x[i], y = ay - s * dir_y[i], z = az - s * dir_z[i];
    reach[i] = x * x + y * y + z * z;
    normal[i] = nx * nx + ny * ny + nz * nz;
  }
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) reach[i] = std::sqrt(reach[i]);
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) normal[i] = std::sqrt(normal[i]);
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float ratio = distance[i] / (reach[i] * normal[i] + std::numeric_limits<float>::min());
    const float at_most_one = ratio < 1 ? ratio : 1, old = facing[i];
    facing[i] = hits[i] != 0 ? at_most_one : old;
  }
}

}  // namespace vantage::detail
