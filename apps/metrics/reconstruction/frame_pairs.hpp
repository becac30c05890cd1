#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vantage {

/// Two of several frames, the lower index first.
using FramePair = std::array<std::size_t, 2>;

/// `most` different pairs of `frames` frames, drawn uniformly; all pairs if there are no more. In
/// ascending order; the same seed draws the same pairs.
std::vector<FramePair> frame_pairs(std::size_t frames, std::size_t most, std::uint64_t seed);

}  // namespace vantage
