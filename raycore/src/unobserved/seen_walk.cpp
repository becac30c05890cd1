// The walk of sixteen rays at a time through what was seen. A ray that is inside a volume goes on
// to where it leaves it. Where no volume has a ray just beyond the place that it has come to, it
// has met the unseen.
//
// Whether a volume has it is for the probe to say: in float, and therefore wrong where a surface is
// near. So its word is only taken if what comes next agrees: Embree's next hit must be a way out of
// the volume, from outside it would be a way in; and where there is none, the ray must still be
// inside where it comes to the volume's outer border or to its own end.

#include "unobserved/seen_walk.hpp"

#include "scene/pixel_tile.hpp"
#include "unobserved/seen_exits.hpp"
#include "unobserved/seen_walkers.hpp"
#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage::raycore::detail {
namespace {

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

[[gnu::always_inline]] inline void walk_each_body(const WalkJob& job, const Intrinsics& k,
                                                  const PixelRotation& R, const PixelTile* tiles,
                                                  std::size_t count, UnseenHits* hits) {
  QueryContext context(true);
  Walkers walkers;
  prepare(walkers.packet.ray);
  for (std::size_t tile = 0; tile < count; ++tile) {
    fill_directions(k, R, tiles[tile], walkers.dir_x, walkers.dir_y, walkers.dir_z);
    walk(job, context, walkers);
    store(job, walkers, hits[tile]);
  }
}
constexpr Multiversion<walk_each_body> walk_each;

}  // namespace

void walk_tiles(const WalkJob& job, const PinholeCamera& camera, std::span<const PixelTile> tiles,
                UnseenHits* hits) {
  walk_each(job, camera.intrinsics(), PixelRotation(camera.T_world_cam().rotation()), tiles.data(),
            tiles.size(), hits);
}

}  // namespace vantage::raycore::detail
