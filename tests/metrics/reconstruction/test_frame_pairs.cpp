#include "metrics/reconstruction/frame_pairs.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

namespace vantage::test {
namespace {

std::vector<FramePair> all_pairs(std::size_t frames) {
  std::vector<FramePair> pairs;
  for (std::size_t i = 0; i < frames; ++i) {
    for (std::size_t j = i + 1; j < frames; ++j) pairs.push_back({i, j});
  }
  return pairs;
}

}  // namespace

TEST_CASE("where there are not more pairs than asked for, it is all of them") {
  for (std::size_t frames = 0; frames < 9; ++frames) {
    CAPTURE(frames);
    const auto all = all_pairs(frames);
    CHECK(frame_pairs(frames, all.size(), 3) == all);
    CHECK(frame_pairs(frames, 1000, 4) == all);
  }
}

TEST_CASE("as many pairs as asked for, all different, in order, the same for the same seed") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    CAPTURE(seed);
    const std::size_t frames = 3 + seed % 20;
    const auto all = all_pairs(frames);
    const std::size_t most = 1 + seed % all.size();
    const auto pairs = frame_pairs(frames, most, seed);
    CHECK(pairs.size() == most);
    CHECK(std::ranges::is_sorted(pairs));
    CHECK(std::set(pairs.begin(), pairs.end()).size() == most);
    CHECK(std::ranges::includes(all, pairs));
    CHECK(frame_pairs(frames, most, seed) == pairs);
  }
  CHECK(frame_pairs(50, 10, 1) != frame_pairs(50, 10, 2));
}

TEST_CASE("no pair is preferred") {
  std::map<FramePair, int> drawn;
  constexpr int kSeeds = 6000;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    for (const FramePair& pair : frame_pairs(6, 5, seed)) ++drawn[pair];
  }
  REQUIRE(drawn.size() == 15);
  // Binomial with p = 1/3: six standard deviations are 220.
  for (const auto& [pair, times] : drawn) CHECK(std::abs(times - kSeeds / 3) < 220);
}

}  // namespace vantage::test
