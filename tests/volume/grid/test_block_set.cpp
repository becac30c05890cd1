#include "grid/block_set.hpp"

#include <doctest/doctest.h>

#include <map>

#include "reference/random_scene.hpp"

namespace vantage::volume::detail {

TEST_CASE("blocks may be set repeatedly, whatever they were before") {
  const BlockLayout layout(GridGeometry::covering(Box({0, 0, 0}, {0.7, 0.37, 0.4}), 0.01));
  BlockSet set(layout), other(layout);
  std::map<std::size_t, BlockBits> expected;
  test::Random random(1);
  const auto random_bits = [&](std::size_t block) {
    const std::uint32_t kind = random.below(3);
    if (kind == 0) return BlockBits{};
    if (kind == 1) return layout.inside(block);
    BlockBits bits;
    for (std::uint64_t& word : bits.words) word = random.below(1u << 31);
    return bits & layout.inside(block);
  };
  for (int i = 0; i < 20000; ++i) {  // hundreds of times for each block
    const std::size_t block = random.below(std::uint32_t(layout.block_count()));
    expected[block] = random_bits(block);
    set.set(block, expected[block]);
    other.set(block, random.below(2) == 0 ? expected[block] : random_bits(block));
  }
  for (const auto& [block, bits] : expected) {
    CHECK(set.bits(block) == bits);
    CHECK(set.none(block) == bits.none());
    CHECK(set.all(block) == (bits == layout.inside(block)));
    CHECK(set.same(block, other) == (other.bits(block) == bits));
    CHECK(set.same(block, set));
  }
}

}  // namespace vantage::volume::detail
