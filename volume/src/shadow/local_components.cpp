#include "shadow/local_components.hpp"

namespace vantage::detail {
namespace {

constexpr std::uint64_t kLowZ = 0x0101010101010101;   // bits with z = 0
constexpr std::uint64_t kHighZ = 0x8080808080808080;  // bits with z = 7

/// The voxels themselves and their neighbours along y and z.
std::uint64_t spread_in_layer(std::uint64_t bits) {
  return bits | (bits << 8) | (bits >> 8) | ((bits & ~kHighZ) << 1) | ((bits & ~kLowZ) >> 1);
}

/// The lowest voxel alone; all off if none is on.
BlockWords lowest(const BlockWords& words) {
  BlockWords result{};
  for (std::size_t x = 0; x < 8; ++x) {
    if (words[x] == 0) continue;
    result[x] = words[x] & -words[x];
    break;
  }
  return result;
}

}  // namespace

BlockWords flooded(const BlockWords& seed, const BlockWords& within) {
  BlockWords reached = seed;
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t x = 0; x < 8; ++x) {
      std::uint64_t next = spread_in_layer(reached[x]);
      if (x > 0) next |= reached[x - 1];
      if (x < 7) next |= reached[x + 1];
      next &= within[x];
      grows |= next != reached[x];
      reached[x] = next;
    }
  }
  return reached;
}

std::vector<BlockWords> local_components(const BlockWords& words) {
  std::vector<BlockWords> components;
  BlockWords rest = words;
  while (count_on(rest) > 0) {
    components.push_back(flooded(lowest(rest), rest));
    for (std::size_t x = 0; x < 8; ++x) rest[x] &= ~components.back()[x];
  }
  return components;
}

}  // namespace vantage::detail
