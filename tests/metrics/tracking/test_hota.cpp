#include "metrics/tracking/hota.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "metrics/tracking/compared_frames.hpp"

namespace vantage::test {

using doctest::Approx;

TEST_CASE("a perfect tracker has HOTA 1") {
  const std::vector<ComparedFrame> frames(5, compared_frame(2, {{7, 1}, {9, 2}}));
  const HotaScores scores = hota(frames);
  CHECK(scores.hota == 1);
  CHECK(scores.detection == 1);
  CHECK(scores.association == 1);
}

TEST_CASE("half of the instants missed, and a phantom: DetA counts both") {
  std::vector<ComparedFrame> frames;
  for (int i = 0; i < 4; ++i) {
    frames.push_back(i < 2 ? compared_frame(1, {{1, 1}}) : compared_frame(1, {{2, 0}}));
  }
  const HotaScores scores = hota(frames);
  CHECK(scores.detection == Approx(2.0 / 6));    // 2 hits, 2 misses, 2 phantoms
  CHECK(scores.association == Approx(2.0 / 4));  // each hit: 2 common, 2 more of the truth
  CHECK(scores.hota == Approx(std::sqrt(2.0 / 6 * 2.0 / 4)));
}

TEST_CASE("a track that changes its id half way keeps half of the association") {
  std::vector<ComparedFrame> frames;
  for (std::uint64_t i = 0; i < 8; ++i) frames.push_back(compared_frame(1, {{i < 4 ? 1u : 2u, 1}}));
  const HotaScores scores = hota(frames);
  CHECK(scores.detection == Approx(1));
  CHECK(scores.association == Approx(0.5));
}

TEST_CASE("similarity decides at how many of the thresholds an estimate is a hit") {
  const std::vector<ComparedFrame> frames(3, compared_frame(1, {{1, 1, 0.5}}));
  const HotaScores scores = hota(frames);
  CHECK(scores.detection == Approx(10.0 / 19));  // 0.05 … 0.5
  CHECK(scores.hota == Approx(10.0 / 19));
}

TEST_CASE("nothing there, nothing found") {
  const std::vector<ComparedFrame> frames(2, compared_frame(0, {}));
  CHECK(hota(frames).hota == 0);
}

}  // namespace vantage::test
