// Sixteen rays on their way through what was seen: where they start, how they go on to where a
// volume ends, and what is told of them when they stand still. One of the volumes is the shell:
// outside of it everything counts as seen.
#pragma once

#include <cstdint>
#include <limits>

#include "scene/ray_packet.hpp"
#include "unobserved/seen_exits.hpp"
#include "unobserved/seen_walk.hpp"

namespace vantage::raycore::detail {

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
    const float t = w.t[i];
    ray.tnear[i] = w.walking[i] != 0 ? t + job.step : 0;
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

}  // namespace vantage::raycore::detail
