#include "classify/anti_alias.hpp"

#include "grid/block_set.hpp"

namespace vantage::volume::detail {

BlockBits aliased_shadow(const BlockSet& shadow, std::size_t block) {
  if (shadow.none(block)) return {};
  const Neighbourhood around(shadow, block);
  BlockBits one_missing, two_missing;  // at least
  for (int axis = 0; axis < 3; ++axis) {
    for (const int step : {-1, 1}) {
      const BlockBits missing = ~around.shifted(axis, step);
      two_missing |= one_missing & missing;
      one_missing |= missing;
    }
  }
  return around.here() & two_missing;
}

}  // namespace vantage::volume::detail
