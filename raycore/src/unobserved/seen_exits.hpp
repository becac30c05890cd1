// How a surface that Embree has met in a lattice's projective space looks at the lattice's camera.
// Where sixteen rays that are inside a lattice's volume get out of it.
//
// Embree has the volume in the lattice's projective space, where a ray's point at depth z from the
// lattice's camera is at (u, v, w). Let p be the point where a query starts, and a how far the ray
// has gone on from there. Its image has gone on by σ · (du - u dz, dv - v dz, -w dz), with
// σ = a / (z + a dz) and u, v, w, z those of p. So a query's direction is the one in brackets, and
// a = σ z / (1 - σ dz): without cancellation where a ray comes nearer to the camera, and to
// kMaxDeeper times a float's precision where it goes away from it.
#pragma once

#include <cmath>
#include <limits>

#include "scene/ray_packet.hpp"
#include "unobserved/lattice_probe.hpp"
#include "unobserved/lattice_scene.hpp"
#include "unobserved/seen_walk.hpp"

namespace vantage::raycore::detail {

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

/// A ray that goes deeper than this many times the depth it starts at is asked for in parts.
inline constexpr float kMaxDeeper = 32;

/// Where rays get out of a volume. Lanes that have not been found have any t and facing.
struct Exits {
  alignas(64) int found[kPacketWidth];
  alignas(64) float t[kPacketWidth], facing[kPacketWidth];
};

/// Directions in the world, and the same for a lattice.
struct ExitRays {
  const float *x, *y, *z;
  const LaneDirections& lattice;
};

/// A part of sixteen rays.
struct LaneParts {
  alignas(64) float start[kPacketWidth], length[kPacketWidth];  ///< in t
  alignas(64) float depth[kPacketWidth];                        ///< at its start
  alignas(64) int asked[kPacketWidth];
};

/// Puts the next part of each ray into the packet.
[[gnu::always_inline]] inline void aim(const WalkVolume& volume, const LaneDirections& d,
                                       const float* t_stop, LaneParts& part, RTCRayHit16& packet) {
  const float u0 = volume.probe.origin[0], v0 = volume.probe.origin[1];
  const float z0 = volume.probe.origin[2], height = volume.probe.probe->height;
  const float min_z = kNearestPart * volume.probe.probe->nearest;
  const unsigned mask = volume.from_apex ? kCellsMask : kAllMasks;
  RTCRay16& ray = packet.ray;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float t = part.start[i], dz = d.z[i], its_z = z0 + t * dz;
    const float z = its_z > min_z ? its_z : min_z, inverse_z = 1 / z;
    const float u = (u0 + t * d.u[i]) * inverse_z, v = (v0 + t * d.v[i]) * inverse_z;
    const float w = height * inverse_z;
    // A ray that has left the box may have gone infinitely far.
    const bool asked = part.asked[i] != 0;
    set_ray(ray, i, asked, u, v, w, d.u[i] - u * dz, d.v[i] - v * dz, -w * dz);
    const float left = t_stop[i] - t, all = left > 0 ? left : 0, some = (kMaxDeeper - 1) * z / dz;
    const float length = (dz > 0) & (some < all) ? some : all;
    const float end_z = z + length * dz, last_z = end_z > min_z ? end_z : min_z;
    part.depth[i] = z;
    part.length[i] = length;
    ray.tnear[i] = 0;
    ray.tfar[i] = asked ? length / last_z : 0;
    ray.mask[i] = mask;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
}

/// A ray from the lattice's camera stays at its pixel. Rounding must not take it across a border.
[[gnu::always_inline]] inline void stand_still(const LatticeProbe& probe, RTCRay16& ray) {
  const float left = probe.columns.first, right = probe.columns.last;
  const float top = probe.rows.first, bottom = probe.rows.last;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float u = ray.org_x[i] > left ? ray.org_x[i] : left;
    const float v = ray.org_y[i] > top ? ray.org_y[i] : top;
    ray.org_x[i] = u < right ? u : right;
    ray.org_y[i] = v < bottom ? v : bottom;
    ray.dir_x[i] = 0, ray.dir_y[i] = 0;
  }
}

/// Takes up the hits of one part.
/// @returns whether any ray goes on to another part, which then begins where this one ended.
[[gnu::always_inline]] inline bool finish_part(const WalkVolume& volume, const ExitRays& rays,
                                               const float* t_stop, LaneParts& part,
                                               RTCRayHit16& packet, int* to_the_end, Exits& exits) {
  const RTCRay16& ray = packet.ray;
  const RTCHit16& hit = packet.hit;
  alignas(64) int hits[kPacketWidth];
  int any_hit = 0, any_more = 0;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    // The way to projective space turns triangles round: what looks outwards looks at the ray.
    const float inwards =
        hit.Ng_x[i] * ray.dir_x[i] + hit.Ng_y[i] * ray.dir_y[i] + hit.Ng_z[i] * ray.dir_z[i];
    const int is_hit = part.asked[i] & -int(hit.geomID[i] != RTC_INVALID_GEOMETRY_ID);
    hits[i] = is_hit & -int(inwards < 0);
    any_hit |= hits[i];
    const float s = ray.tfar[i];
    const float a = s * part.depth[i] / (1 - s * rays.lattice.z[i]);
    const float length = part.length[i], t = part.start[i] + (a < length ? a : length);
    const float old_t = exits.t[i];
    exits.t[i] = hits[i] != 0 ? t : old_t;
    exits.found[i] |= hits[i];
    const float end = part.start[i] + length;
    const int missed = part.asked[i] & ~is_hit;
    // Up to rounding a part's end is the ray's, unless it was cut.
    const int is_cut = -int((length < t_stop[i] - part.start[i]) & (end > part.start[i]));
    to_the_end[i] |= missed & ~is_cut;
    part.asked[i] = missed & is_cut;
    any_more |= part.asked[i];
    part.start[i] = end;
  }
  if (any_hit != 0)
    store_facing(volume, rays.x, rays.y, rays.z, exits.t, hits, packet, exits.facing);
  return any_more != 0;
}

/// Of the lanes in `to_the_end`, those whose rays still are in front of the surface get out there.
[[gnu::always_inline]] inline void add_ends(const WalkVolume& volume, const LaneDirections& d,
                                            const float* t_stop, int* to_the_end, Exits& exits) {
  int any = 0;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) any |= to_the_end[i];
  if (any == 0) return;
  LanePixels pixels;
  project_lanes(volume.probe, d, t_stop, pixels);
  keep_in_front(*volume.probe.probe, pixels, to_the_end);
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float t = exits.t[i], stop = t_stop[i], facing = exits.facing[i];
    exits.t[i] = to_the_end[i] != 0 ? stop : t;
    exits.facing[i] = to_the_end[i] != 0 ? 0 : facing;
    exits.found[i] |= to_the_end[i];
  }
}

/// Finds where the lanes in `inside` get out of the volume between t_near and t_stop: by a hit, or
/// at t_stop, if they still are inside there.
[[gnu::always_inline]] inline void find_exits(const WalkVolume& volume, QueryContext& context,
                                              const ExitRays& rays, const float* t_near,
                                              const float* t_stop, const int* inside,
                                              RTCRayHit16& packet, Exits& exits) {
  LaneParts part;
  alignas(64) int to_the_end[kPacketWidth];
  const float z0 = volume.probe.origin[2], clear = volume.clear_depth;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float t = t_near[i], stop = t_stop[i], dz = rays.lattice.z[i], z = z0 + t * dz;
    // Where nothing can be met the ray need not be asked for.
    const float jump = (clear - z) / dz, room = stop - t;
    const float least = jump < room ? jump : room;
    part.start[i] = (z < clear) & (dz > 0) & (room > 0) ? t + least : t;
    part.asked[i] = inside[i] & -int(room >= 0);
    to_the_end[i] = 0;
    exits.found[i] = 0;
    exits.t[i] = t;
    exits.facing[i] = 0;
  }
  do {
    aim(volume, rays.lattice, t_stop, part, packet);
    if (volume.from_apex) stand_still(*volume.probe.probe, packet.ray);
    context.intersect16(part.asked, volume.scene, &packet);
  } while (finish_part(volume, rays, t_stop, part, packet, to_the_end, exits));
  add_ends(volume, rays.lattice, t_stop, to_the_end, exits);
}

}  // namespace vantage::raycore::detail
