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

#include "seen_exits.hpp"
#include "tile_rays.hpp"
#include "vantage/raycore/multiversion.hpp"

namespace vantage::detail {
namespace {

/// Sixteen rays on their way. Of a mask's lanes -1 is true and 0 false.
struct Walkers {
  RTCRayHit16 packet{};
  alignas(64) float dir_x[kPacketWidth], dir_y[kPacketWidth], dir_z[kPacketWidth];
  alignas(64) float t[kPacketWidth];       ///< everything up to here is seen
  alignas(64) float t_end[kPacketWidth];   ///< where the box or the range ends
  alignas(64) float end[kPacketWidth];     ///< where the shell ends, if that is before
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
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    w.t[i] = 0;
    w.t_end[i] = job.t_far;
    w.facing[i] = 0;
    w.source[i] = UnseenHits::kNoSource;
    w.refusals[i] = 0;
  }
  clip_axis(job.box_min[0], job.box_max[0], w.dir_x, w.t, w.t_end);
  clip_axis(job.box_min[1], job.box_max[1], w.dir_y, w.t, w.t_end);
  clip_axis(job.box_min[2], job.box_max[2], w.dir_z, w.t, w.t_end);
  int any = 0;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    w.end[i] = w.t_end[i];
    w.walking[i] = -int(w.t[i] + job.step < w.t_end[i]);
    any |= w.walking[i];
  }
  return any != 0;
}

/// The walkers that got out of a volume go there.
[[gnu::always_inline]] inline void move_on(std::uint32_t index, const Exits& exits, Walkers& w) {
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const bool moves = exits.found[i] != 0;
    const float t = exits.t[i], facing = exits.facing[i];
    const float old_t = w.t[i], old_facing = w.facing[i];
    const std::uint32_t source = w.source[i];
    w.t[i] = moves ? t : old_t;
    w.facing[i] = moves ? facing : old_facing;
    w.source[i] = moves ? index : source;
  }
}

/// Asks once more for lanes that the probe has inside and Embree has not: with rays turned by a
/// millionth, because of rays aimed at a shared vertex, as those of a camera that stands where a
/// lattice's stood, some slip through. The exits of the others stay.
void ask_again(const WalkVolume& volume, QueryContext& context, Walkers& w, const float* t_near,
               const float* t_stop, const int* missed, Exits& exits) {
  alignas(64) float x[kPacketWidth], y[kPacketWidth], z[kPacketWidth];
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const Eigen::Vector3f d(w.dir_x[i], w.dir_y[i], w.dir_z[i]);
    const Eigen::Vector3f e = d + d.cross(Eigen::Vector3f(3.6e-7f, 4.8e-7f, 8e-7f));
    x[i] = e.x(), y[i] = e.y(), z[i] = e.z();
  }
  LaneDirections directions;
  turn_lanes(volume.probe, x, y, z, directions);
  Exits found;
  find_exits(volume, context, {x, y, z, directions}, t_near, t_stop, missed, w.packet, found);
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    if (found.found[i] == 0) continue;
    exits.found[i] = -1;
    exits.t[i] = found.t[i];
    exits.facing[i] = found.facing[i];
  }
}

/// Finds the walkers that are inside the volume just beyond t.
[[gnu::always_inline]] inline bool find_inside(const WalkVolume& volume, const Walkers& w,
                                               const LaneDirections& directions,
                                               const float* t_near, int* inside) {
  LanePixels pixels;
  project_lanes(volume.probe, directions, t_near, pixels);
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) inside[i] = w.walking[i];
  const LatticeProbe& probe = *volume.probe.probe;
  return keep_in_image(probe, pixels, inside) && keep_in_front(probe, pixels, inside);
}

/// Lets the walkers that are inside the volume go to its end.
/// @returns whether there are any; `exits` has which of them went.
[[gnu::always_inline]] inline bool leave(const WalkVolume& volume, QueryContext& context,
                                         Walkers& w, Exits& exits) {
  alignas(64) float t_near[kPacketWidth], t_stop[kPacketWidth];
  alignas(64) int inside[kPacketWidth], missed[kPacketWidth];
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    t_near[i] = w.t[i] + volume.step;
    // A little beyond the end, because a floor that was measured may lie in the box's face.
    t_stop[i] = w.t_end[i] + 2 * volume.step;
  }
  LaneDirections directions;
  turn_lanes(volume.probe, w.dir_x, w.dir_y, w.dir_z, directions);
  if (!find_inside(volume, w, directions, t_near, inside)) return false;
  if (!volume.from_apex) stop_at_borders(volume.probe, directions, t_stop);
  find_exits(volume, context, {w.dir_x, w.dir_y, w.dir_z, directions}, t_near, t_stop, inside,
             w.packet, exits);
  int any_missed = 0;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    missed[i] = inside[i] & ~exits.found[i];
    any_missed |= missed[i];
  }
  if (any_missed != 0) ask_again(volume, context, w, t_near, t_stop, missed, exits);
  move_on(volume.index, exits, w);
  return true;
}

/// Lets the walkers that are outside of the shell go to where they enter it, or to their ends.
[[gnu::always_inline]] inline void enter_shell(const WalkJob& job, QueryContext& context,
                                               Walkers& w, Exits& exits) {
  RTCRay16& ray = w.packet.ray;
  RTCHit16& hit = w.packet.hit;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    ray.org_x[i] = job.shell.origin[0];
    ray.org_y[i] = job.shell.origin[1];
    ray.org_z[i] = job.shell.origin[2];
    ray.dir_x[i] = w.dir_x[i], ray.dir_y[i] = w.dir_y[i], ray.dir_z[i] = w.dir_z[i];
    ray.tnear[i] = w.t[i] + job.step;
    // Beyond the box, too: what is inside there is inside.
    ray.tfar[i] = std::numeric_limits<float>::infinity();
    ray.mask[i] = kAllMasks;
    hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  context.intersect16(w.walking, job.shell.scene, &w.packet);
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float outwards =
        hit.Ng_x[i] * ray.dir_x[i] + hit.Ng_y[i] * ray.dir_y[i] + hit.Ng_z[i] * ray.dir_z[i];
    const bool is_hit = hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    const float its_end = w.t_end[i], border = ray.tfar[i];
    const float at = is_hit & (border < its_end) ? border : its_end;
    const int outside = w.walking[i] & -int(!is_hit | (outwards < 0));
    const float end = w.end[i];
    exits.found[i] = outside;
    exits.t[i] = at;
    w.end[i] = (w.walking[i] & ~outside) != 0 ? at : end;
    exits.facing[i] = 0;
  }
  move_on(UnseenHits::kNoSource, exits, w);
}

/// After a volume: who goes on?
/// @param counted how many refusals it is to have been let out of it just now
/// @returns whether anyone does.
[[gnu::always_inline]] inline bool count_refusals(const WalkJob& job, const int* exits, int counted,
                                                  Walkers& w) {
  const int all = int(job.volumes.size()) + (job.shell.scene != nullptr ? 1 : 0);
  int any = 0;
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    w.refusals[i] = exits[i] != 0 ? counted : w.refusals[i] + 1;
    w.walking[i] &= -int((w.refusals[i] < all) & (w.t[i] + job.step < w.t_end[i]));
    any |= w.walking[i];
  }
  return any != 0;
}

[[gnu::always_inline]] inline void walk(const WalkJob& job, QueryContext& context, Walkers& w) {
  const bool has_shell = job.shell.scene != nullptr;
  if (!start(job, w) || (job.volumes.empty() && !has_shell)) return;
  Exits exits;
  alignas(64) constexpr int kNone[kPacketWidth] = {};
  for (;;) {
    if (has_shell) {
      enter_shell(job, context, w, exits);
      // It will be asked once more, for where it ends.
      if (!count_refusals(job, exits.found, 0, w)) return;
    }
    for (const WalkVolume& volume : job.volumes) {
      const bool any = leave(volume, context, w, exits);
      // The volume that was left just now need not be asked again: it counts.
      if (!count_refusals(job, any ? exits.found : kNone, 1, w)) return;
    }
  }
}

[[gnu::always_inline]] inline void store(const WalkJob& job, const Walkers& w, UnseenHits& hits) {
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float t = w.t[i], facing = w.facing[i], end = w.end[i];
    const std::uint32_t source = w.source[i];
    const bool hit = t + job.step < w.t_end[i];
    hits.t[i] = hit ? t : std::numeric_limits<float>::infinity();
    hits.end[i] = hit ? end : std::numeric_limits<float>::infinity();
    hits.facing[i] = hit ? facing : 0;
    hits.source[i] = hit ? source : UnseenHits::kNoSource;
  }
}

VANTAGE_MULTIVERSION
void walk_each(const WalkJob& job, const Intrinsics& k, const PixelRotation& R,
               const PixelTile* tiles, std::size_t count, UnseenHits* hits) {
  QueryContext context(true);
  Walkers walkers;
  prepare(walkers.packet.ray);
  for (std::size_t tile = 0; tile < count; ++tile) {
    fill_directions(k, R, tiles[tile], walkers.dir_x, walkers.dir_y, walkers.dir_z);
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
