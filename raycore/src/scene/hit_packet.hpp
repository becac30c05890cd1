#pragma once

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "scene/packet.hpp"
#include "vantage/raycore/scene.hpp"

namespace vantage::detail {

struct RayLanes {
  const float *org_x, *org_y, *org_z;
  const float *dir_x, *dir_y, *dir_z;
};

/// Loads the `count` rays from `first` on into a packet; the last one fills up the lanes behind.
/// kOriginStride 0: all rays start in one point. kFull: `count` is the packet's width. Both decide
/// at compile time what would otherwise keep the loop from being vectorised.
/// @returns whether Embree may see all of them; `valid` leaves out those that it may not see.
template <std::size_t kOriginStride, bool kFull>
[[gnu::always_inline]] inline bool fill(const PacketJob& job, const RayLanes& r, std::size_t first,
                                        std::size_t count, RTCRayHit16& packet, int* valid) {
  int refused = 0;
  RTCRay16& rays = packet.ray;
  for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
    const std::size_t i = first + (kFull ? lane : std::min(lane, count - 1));
    const float ox = r.org_x[i * kOriginStride];
    const float oy = r.org_y[i * kOriginStride];
    const float oz = r.org_z[i * kOriginStride];
    const float dx = r.dir_x[i], dy = r.dir_y[i], dz = r.dir_z[i];
    const int ok = valid_ray(ox, oy, oz, dx, dy, dz);
    set_ray(rays, lane, ok, ox, oy, oz, dx, dy, dz);
    refused |= 1 - ok;
    valid[lane] = kFull ? -ok : -(ok & int(lane < count));
  }
  for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
    rays.tfar[lane] = job.t_far;
    packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
  }
  return refused == 0;
}

struct HitLanes {
  float *t, *u, *v;
  ObjectId* object;
  std::uint32_t* triangle;
  float *normal_x, *normal_y, *normal_z;

  explicit HitLanes(Hits& h)
      : t(h.t.data()),
        u(h.u.data()),
        v(h.v.data()),
        object(h.object.data()),
        triangle(h.triangle.data()),
        normal_x(h.normal.x.data()),
        normal_y(h.normal.y.data()),
        normal_z(h.normal.z.data()) {}
};

/// Makes 16 normals unit vectors. By the largest component first: the normal of a triangle of a
/// nanometre is so short that its square would underflow. The roots have a loop of their own: the
/// compiler vectorises the others, but keeps calls that may set errno apart.
[[gnu::always_inline]] inline void make_unit(float* x, float* y, float* z) {
  alignas(64) float length[kPacketWidth];
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float ax = std::fabs(x[i]), ay = std::fabs(y[i]), az = std::fabs(z[i]);
    const float axy = ax > ay ? ax : ay;
    const float largest = axy > az ? axy : az;
    const float scale = 1 / (largest + std::numeric_limits<float>::min());  // never infinite
    x[i] *= scale, y[i] *= scale, z[i] *= scale;
    length[i] = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
  }
  for (std::size_t i = 0; i < kPacketWidth; ++i) length[i] = std::sqrt(length[i]);
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float scale = 1 / length[i];
    x[i] *= scale, y[i] *= scale, z[i] *= scale;
  }
}

/// Turns what Embree left in a packet into a Hits' fields, all lanes at once: a lane that missed
/// gets a miss's values.
[[gnu::always_inline]] inline void finish(RTCRayHit16& packet) {
  RTCHit16& hit = packet.hit;
  make_unit(hit.Ng_x, hit.Ng_y, hit.Ng_z);
  for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
    // Everything is loaded first: a load on a condition would not be vectorised.
    const unsigned geometry = hit.geomID[lane], instance = hit.instID[0][lane];
    const unsigned triangle = hit.primID[lane];
    const float t = packet.ray.tfar[lane], u = hit.u[lane], v = hit.v[lane];
    const float x = hit.Ng_x[lane], y = hit.Ng_y[lane], z = hit.Ng_z[lane];
    const bool is_hit = geometry != RTC_INVALID_GEOMETRY_ID;
    packet.ray.tfar[lane] = is_hit ? t : std::numeric_limits<float>::infinity();
    hit.u[lane] = is_hit ? u : 0;
    hit.v[lane] = is_hit ? v : 0;
    hit.Ng_x[lane] = is_hit ? x : 0;
    hit.Ng_y[lane] = is_hit ? y : 0;
    hit.Ng_z[lane] = is_hit ? z : 0;
    hit.primID[lane] = is_hit ? triangle : 0;
    hit.geomID[lane] = instance != RTC_INVALID_GEOMETRY_ID ? instance : geometry;
  }
}

[[gnu::always_inline]] inline void store(const RTCRayHit16& packet, std::size_t first,
                                         std::size_t count, const HitLanes& out) {
  const auto copy = [&](auto* to, const auto* from) {
    static_assert(sizeof(*to) == sizeof(*from));
    std::memcpy(to + first, from, count * sizeof(*from));
  };
  copy(out.t, packet.ray.tfar);
  copy(out.u, packet.hit.u);
  copy(out.v, packet.hit.v);
  copy(out.object, packet.hit.geomID);
  copy(out.triangle, packet.hit.primID);
  copy(out.normal_x, packet.hit.Ng_x);
  copy(out.normal_y, packet.hit.Ng_y);
  copy(out.normal_z, packet.hit.Ng_z);
}

}  // namespace vantage::detail
