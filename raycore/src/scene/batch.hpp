#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cstddef>

#include "core/packet_bits.hpp"
#include "scene/ray_packet.hpp"

namespace vantage::raycore::detail {

/// Rays that one task traces. A multiple of the packet width, and fixed: packets then hold the same
/// rays at any number of threads, and with that every bit of the result is the same.
inline constexpr std::size_t kBlockRays = 1024;
static_assert(kBlockRays % kPacketWidth == 0);

/// Calls `block(first, last)` for fixed parts of 0 … count in the caller's task arena.
/// @returns whether every call returned true.
template <class Block>
bool for_each_block(std::size_t count, const Block& block) {
  if (count <= kBlockRays) return count == 0 || block(0, count);
  std::atomic<bool> ok{true};
  const std::size_t blocks = (count + kBlockRays - 1) / kBlockRays;
  tbb::parallel_for(std::size_t(0), blocks, [&](std::size_t b) {
    const std::size_t first = b * kBlockRays;
    if (!block(first, std::min(first + kBlockRays, count))) ok.store(false);
  });
  return ok.load();
}

/// Called when a batch held a ray that Embree must not see.
/// @throws Error bad_input that names the first such ray and what is wrong with it.
[[noreturn]] void refuse_first_segment(PointsView from, const PointLanes& to);
[[noreturn]] void refuse_segment(std::size_t index, const Eigen::Vector3f& from,
                                 const Eigen::Vector3f& to);
[[noreturn]] void refuse_first_ray(const PointLanes& origins, PointsView directions);

}  // namespace vantage::raycore::detail
