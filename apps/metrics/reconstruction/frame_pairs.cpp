#include "metrics/reconstruction/frame_pairs.hpp"

#include <algorithm>
#include <set>

#include "simulator/scene/sample_hash.hpp"

namespace vantage {
namespace {

/// `most` different numbers below `count` (R. Floyd's algorithm: J. Bentley, "Programming Pearls: a
/// sample of brilliance", 1987).
std::set<std::size_t> sample(std::size_t count, std::size_t most, std::uint64_t seed) {
  std::set<std::size_t> chosen;
  for (std::size_t last = count - most; last < count; ++last) {
    const std::size_t drawn = sample_hash(seed, last) % (last + 1);
    if (!chosen.insert(drawn).second) chosen.insert(last);
  }
  return chosen;
}

}  // namespace

std::vector<FramePair> frame_pairs(std::size_t frames, std::size_t most, std::uint64_t seed) {
  if (frames < 2) return {};
  const std::size_t count = frames * (frames - 1) / 2;
  std::vector<FramePair> pairs;
  // Pairs are numbered frame by frame: `before` is the number of the first one of `first`.
  std::size_t first = 0, before = 0;
  for (const std::size_t number : sample(count, std::min(most, count), seed)) {
    while (number - before >= frames - 1 - first) before += frames - 1 - first++;
    pairs.push_back({first, first + 1 + number - before});
  }
  return pairs;
}

}  // namespace vantage
