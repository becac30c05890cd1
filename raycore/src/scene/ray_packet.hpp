#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "scene/embree.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/points.hpp"

namespace vantage::raycore::detail {

// Embree's own limit is 1.8e18; below this one nothing overflows on the way to it either.
inline constexpr float kFarthestCoordinate = 1e9f;

/// N points that are all the same, or an array of them, behind one way to load a lane.
struct PointLanes {
  PointsView view;
  std::size_t stride;  ///< 0 or 1

  explicit PointLanes(PointsView points) : view(points), stride(1) {}
  PointLanes(const Eigen::Vector3f& p, std::size_t size)
      : view{&p.x(), &p.y(), &p.z(), size}, stride(0) {}

  Eigen::Vector3f operator[](std::size_t i) const { return view[i * stride]; }
};

/// Whether a point is near enough. Written so that NaN fails, and without branches.
inline bool in_reach(float x, float y, float z) {
  return (std::fabs(x) <= kFarthestCoordinate) & (std::fabs(y) <= kFarthestCoordinate) &
         (std::fabs(z) <= kFarthestCoordinate);
}

/// Whether Embree may see a ray.
inline bool valid_ray(float ox, float oy, float oz, float dx, float dy, float dz) {
  return in_reach(ox, oy, oz) & in_reach(dx, dy, dz) & ((dx != 0) | (dy != 0) | (dz != 0));
}

/// Whether Embree may see the segment between two points.
inline bool valid_segment(float ox, float oy, float oz, float tx, float ty, float tz) {
  return in_reach(ox, oy, oz) & in_reach(tx, ty, tz) & ((tx != ox) | (ty != oy) | (tz != oz));
}

/// Where segments end, in parts of their length: to touch is to be occluded, and the distance that
/// Embree computes is off by up to three of a float's last bits where there is no FMA.
inline constexpr float kSegmentEnd = 1 + 0x1p-21f;

/// Puts a ray into a lane; where Embree may not see it, one that it may see. To leave such a lane
/// out by the packet's mask is not enough: on machines without AVX-512 Embree looks at all of them.
[[gnu::always_inline]] inline void set_ray(RTCRay16& rays, std::size_t lane, bool valid, float ox,
                                           float oy, float oz, float dx, float dy, float dz) {
  rays.org_x[lane] = valid ? ox : 0, rays.org_y[lane] = valid ? oy : 0;
  rays.org_z[lane] = valid ? oz : 0;
  rays.dir_x[lane] = valid ? dx : 1, rays.dir_y[lane] = valid ? dy : 1;
  rays.dir_z[lane] = valid ? dz : 1;
}

/// What all rays of a query share.
struct PacketJob {
  RTCScene scene;
  bool coherent;
  float t_far;
};

/// Sets the fields of a packet that no query changes.
inline void prepare(RTCRay16& rays) {
  for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
    rays.tnear[lane] = 0;
    rays.time[lane] = 0;
    rays.mask[lane] = kAllMasks;
    rays.id[lane] = 0;
    rays.flags[lane] = 0;
  }
}

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

}  // namespace vantage::raycore::detail
