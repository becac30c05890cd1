// The walk of sixteen rays at a time through what was seen. A ray that is inside a volume goes on
// to where it leaves it. Where no volume has a ray just beyond the place that it has come to, it
// has met the unseen.
//
// Whether a volume has it is for the probe to say: in float, and therefore wrong where a surface is
// near. So its word is only taken if what comes next agrees: Embree's next hit must be a way out of
// the volume, from outside it would be a way in; and where there is none, the ray must still be
// inside where it comes to the volume's outer border or to its own end.

#include "seen_walk.hpp"

#include <cmath>
#include <limits>

#include "hit_packet.hpp"
#include "lattice_scene.hpp"
#include "tile_rays.hpp"
#include "vantage/raycore/multiversion.hpp"

namespace vantage::detail {
namespace {

/// Sixteen rays on their way. Of a mask's lanes -1 is true and 0 false.
struct Walkers {
  alignas(64) RTCRayHit16 packet{};
  alignas(64) float t[kPacketWidth];       ///< everything up to here is seen
  alignas(64) float t_end[kPacketWidth];   ///< where the box or the range ends
  alignas(64) float facing[kPacketWidth];  ///< of the surface at t
  alignas(64) std::uint32_t source[kPacketWidth];
  alignas(64) int walking[kPacketWidth];
  alignas(64) int refusals[kPacketWidth];  ///< by volumes in a row; all of them end the walk
};

[[gnu::always_inline]] inline void clip_axis(float low, float high, const float* direction,
                                             float* entry, float* exit) {
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float inverse = 1 / direction[i];
    const float a = low * inverse, b = high * inverse;
    // Written so that a NaN, of a ray in the plane of a face, leaves the other bound.
    const float first = a < b ? a : b, last = a > b ? a : b;
    entry[i] = first > entry[i] ? first : entry[i];
    exit[i] = last < exit[i] ? last : exit[i];
  }
}

/// Puts the walkers where their rays enter the box.
/// @returns whether any does.
[[gnu::always_inline]] inline bool start(const WalkJob& job, Walkers& w) {
  const RTCRay16& rays = w.packet.ray;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    w.t[i] = 0;
    w.t_end[i] = job.t_far;
    w.facing[i] = 0;
    w.source[i] = UnseenHits::kNoSource;
    w.refusals[i] = 0;
  }
  clip_axis(job.box_min[0], job.box_max[0], rays.dir_x, w.t, w.t_end);
  clip_axis(job.box_min[1], job.box_max[1], rays.dir_y, w.t, w.t_end);
  clip_axis(job.box_min[2], job.box_max[2], rays.dir_z, w.t, w.t_end);
  int any = 0;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    w.walking[i] = -int(w.t[i] + job.step < w.t_end[i]);
    any |= w.walking[i];
  }
  return any != 0;
}

/// Asks where the lanes in `inside` meet the volume's surface next, from t_near to t_stop.
[[gnu::always_inline]] inline void intersect(const WalkVolume& volume, QueryContext& context,
                                             const float* t_near, const float* t_stop,
                                             const int* inside, RTCRayHit16& packet) {
  const unsigned mask = volume.from_apex ? kCellsMask : kAllMasks;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    packet.ray.tnear[i] = t_near[i];
    packet.ray.tfar[i] = t_stop[i];
    packet.ray.mask[i] = mask;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  context.intersect16(inside, volume.scene, &packet);
}

/// Of the lanes in `asked`, those that get out of the volume at tfar: by a hit, or where the query
/// ended and they still were inside.
[[gnu::always_inline]] inline void find_exits(const WalkVolume& volume, const RTCRayHit16& packet,
                                              const int* asked, int* exits) {
  const RTCRay16& ray = packet.ray;
  const RTCHit16& hit = packet.hit;
  alignas(64) int to_the_end[kPacketWidth];
  int any = 0;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float outwards =
        hit.Ng_x[i] * ray.dir_x[i] + hit.Ng_y[i] * ray.dir_y[i] + hit.Ng_z[i] * ray.dir_z[i];
    const int is_hit = -int(hit.geomID[i] != RTC_INVALID_GEOMETRY_ID);
    exits[i] = asked[i] & is_hit & -int(outwards > 0);
    to_the_end[i] = asked[i] & ~is_hit & -int(ray.tfar[i] >= ray.tnear[i]);
    any |= to_the_end[i];
  }
  if (any == 0) return;
  LanePixels pixels;
  project_lanes(volume.probe, ray.dir_x, ray.dir_y, ray.dir_z, ray.tfar, pixels);
  keep_in_front(*volume.probe.probe, pixels, to_the_end);
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) exits[i] |= to_the_end[i];
}

/// The walkers in `exits` go to their hits.
[[gnu::always_inline]] inline void move_on(const WalkVolume& volume, const int* exits, Walkers& w) {
  RTCRay16& ray = w.packet.ray;
  RTCHit16& hit = w.packet.hit;
  make_unit(hit.Ng_x, hit.Ng_y, hit.Ng_z);  // NaN where there is no hit
  const float ax = volume.apex[0], ay = volume.apex[1], az = volume.apex[2];
  alignas(64) float length[kPacketWidth], cosine[kPacketWidth];
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float t = ray.tfar[i];
    const float x = ax - t * ray.dir_x[i], y = ay - t * ray.dir_y[i], z = az - t * ray.dir_z[i];
    length[i] = x * x + y * y + z * z;
    cosine[i] = std::fabs(hit.Ng_x[i] * x + hit.Ng_y[i] * y + hit.Ng_z[i] * z);
  }
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) length[i] = std::sqrt(length[i]);
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float ratio = cosine[i] / (length[i] + std::numeric_limits<float>::min());
    const float at_most_one = ratio < 1 ? ratio : 1;
    const float facing = hit.geomID[i] != RTC_INVALID_GEOMETRY_ID ? at_most_one : 0;
    const bool moves = exits[i] != 0;
    const float t = ray.tfar[i], old_t = w.t[i], old_facing = w.facing[i];
    const std::uint32_t source = w.source[i];
    w.t[i] = moves ? t : old_t;
    w.facing[i] = moves ? facing : old_facing;
    w.source[i] = moves ? volume.index : source;
  }
}

/// Asks once more for lanes that the probe has inside and Embree has not: with rays turned by a
/// millionth, because of rays aimed at a shared vertex, as those of a camera that stands where a
/// lattice's stood, some slip through. The hits of the others stay.
void ask_again(const WalkVolume& volume, QueryContext& context, const float* t_near,
               const float* t_stop, const int* missed, RTCRayHit16& packet, int* exits) {
  RTCRayHit16 turned = packet;
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const Eigen::Vector3f d(packet.ray.dir_x[i], packet.ray.dir_y[i], packet.ray.dir_z[i]);
    const Eigen::Vector3f e = d + d.cross(Eigen::Vector3f(3.6e-7f, 4.8e-7f, 8e-7f));
    turned.ray.dir_x[i] = e.x(), turned.ray.dir_y[i] = e.y(), turned.ray.dir_z[i] = e.z();
  }
  intersect(volume, context, t_near, t_stop, missed, turned);
  int found[kPacketWidth];
  find_exits(volume, turned, missed, found);
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    if (found[i] == 0) continue;
    exits[i] = -1;
    packet.ray.tfar[i] = turned.ray.tfar[i];
    packet.hit.geomID[i] = turned.hit.geomID[i];
    packet.hit.Ng_x[i] = turned.hit.Ng_x[i];
    packet.hit.Ng_y[i] = turned.hit.Ng_y[i];
    packet.hit.Ng_z[i] = turned.hit.Ng_z[i];
  }
}

/// Finds the walkers that are inside the volume just beyond t.
[[gnu::always_inline]] inline bool find_inside(const WalkVolume& volume, const Walkers& w,
                                               const float* t_near, int* inside) {
  const RTCRay16& ray = w.packet.ray;
  LanePixels pixels;
  project_lanes(volume.probe, ray.dir_x, ray.dir_y, ray.dir_z, t_near, pixels);
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) inside[i] = w.walking[i];
  const LatticeProbe& probe = *volume.probe.probe;
  return keep_in_image(probe, pixels, inside) && keep_in_front(probe, pixels, inside);
}

/// Lets the walkers that are inside the volume go to its end.
/// @returns whether there are any; `exits` has which of them went.
[[gnu::always_inline]] inline bool leave(const WalkVolume& volume, QueryContext& context,
                                         Walkers& w, int* exits) {
  const RTCRay16& ray = w.packet.ray;
  alignas(64) float t_near[kPacketWidth], t_stop[kPacketWidth];
  alignas(64) int inside[kPacketWidth], missed[kPacketWidth];
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    t_near[i] = w.t[i] + volume.step;
    // A little beyond the end, because a floor that was measured may lie in the box's face.
    t_stop[i] = w.t_end[i] + 2 * volume.step;
  }
  if (!find_inside(volume, w, t_near, inside)) return false;
  if (!volume.from_apex) {
    stop_at_borders(volume.probe, ray.dir_x, ray.dir_y, ray.dir_z, t_stop);
  }
  intersect(volume, context, t_near, t_stop, inside, w.packet);
  find_exits(volume, w.packet, inside, exits);
  int any_missed = 0;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    missed[i] = inside[i] & ~exits[i];
    any_missed |= missed[i];
  }
  if (any_missed != 0) ask_again(volume, context, t_near, t_stop, missed, w.packet, exits);
  move_on(volume, exits, w);
  return true;
}

/// After a volume: who goes on?
/// @returns whether anyone does.
[[gnu::always_inline]] inline bool count_refusals(const WalkJob& job, const int* exits,
                                                  Walkers& w) {
  const int all = int(job.volumes.size());
  int any = 0;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    // The volume that was left just now need not be asked again: it counts.
    w.refusals[i] = exits[i] != 0 ? 1 : w.refusals[i] + 1;
    w.walking[i] &= -int((w.refusals[i] < all) & (w.t[i] + job.step < w.t_end[i]));
    any |= w.walking[i];
  }
  return any != 0;
}

[[gnu::always_inline]] inline void walk(const WalkJob& job, QueryContext& context, Walkers& w) {
  if (!start(job, w) || job.volumes.empty()) return;
  alignas(64) int exits[kPacketWidth];
  alignas(64) constexpr int kNone[kPacketWidth] = {};
  for (;;) {
    for (const WalkVolume& volume : job.volumes) {
      const bool any = leave(volume, context, w, exits);
      if (!count_refusals(job, any ? exits : kNone, w)) return;
    }
  }
}

[[gnu::always_inline]] inline void store(const WalkJob& job, const Walkers& w, UnseenHits& hits) {
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float t = w.t[i], facing = w.facing[i];
    const std::uint32_t source = w.source[i];
    const bool hit = t + job.step < w.t_end[i];
    hits.t[i] = hit ? t : std::numeric_limits<float>::infinity();
    hits.facing[i] = hit ? facing : 0;
    hits.source[i] = hit ? source : UnseenHits::kNoSource;
  }
}

VANTAGE_MULTIVERSION
void walk_each(const WalkJob& job, const Intrinsics& k, const PixelRotation& R,
               const PixelTile* tiles, std::size_t count, UnseenHits* hits) {
  QueryContext context(true);
  Walkers walkers;
  RTCRay16& rays = walkers.packet.ray;
  prepare(rays);
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    rays.org_x[i] = job.origin[0], rays.org_y[i] = job.origin[1], rays.org_z[i] = job.origin[2];
  }
  for (std::size_t tile = 0; tile < count; ++tile) {
    fill_directions(k, R, tiles[tile], rays);
    walk(job, context, walkers);
    store(job, walkers, hits[tile]);
  }
}

}  // namespace

void walk_tiles(const WalkJob& job, const PinholeCamera& camera, std::span<const PixelTile> tiles,
                UnseenHits* hits) {
  walk_each(job, camera.intrinsics(), PixelRotation(camera.T_world_cam().rotation()), tiles.data(),
            tiles.size(), hits);
}

}  // namespace vantage::detail
