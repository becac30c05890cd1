#pragma once

#include <limits>

#include "unobserved/seen_walkers.hpp"

// The shell as a volume of the walk: outside of it everything counts as seen.

namespace vantage::detail {

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

}  // namespace vantage::detail
