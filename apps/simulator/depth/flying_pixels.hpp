#pragma once

#include <cstdint>
#include <vector>

namespace vantage::simulator::detail {

/// At a jump in depth, stereo matching sometimes mixes both sides. A pixel beside a jump of more
/// than 2 % of its depth takes, with probability `share`, a disparity between its own and its
/// neighbour's.
/// @param metres row-major, NaN unknown; changed in place.
void add_flying_pixels(std::vector<float>& metres, int width, int height, double share,
                       std::uint64_t seed);

}  // namespace vantage::simulator::detail
