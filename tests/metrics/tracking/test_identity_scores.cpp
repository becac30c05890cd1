#include "metrics/tracking/identity_scores.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "metrics/tracking/compared_frames.hpp"
#include "reference/random_scene.hpp"

namespace vantage::test {
namespace {

using doctest::Approx;

std::vector<ComparedFrame> exchanged_half_way(int instants) {
  std::vector<ComparedFrame> frames;
  for (int i = 0; i < instants; ++i) {
    frames.push_back(i < instants / 2 ? compared_frame(2, {{1, 1}, {2, 2}})
                                      : compared_frame(2, {{1, 2}, {2, 1}}));
  }
  return frames;
}

/// The most true positives of any assignment of estimates' ids 1 … n to true ones 1 … n.
std::size_t true_positives_by_trying(const std::vector<ComparedFrame>& frames, std::size_t n) {
  std::vector<std::uint64_t> id_of(n);
  std::iota(id_of.begin(), id_of.end(), 1u);
  std::size_t best = 0;
  do {
    std::size_t count = 0;
    for (const ComparedFrame& frame : frames) {
      for (std::size_t t = 0; t < frame.truth.size(); ++t) {
        for (std::size_t e = 0; e < frame.estimates.size(); ++e) {
          count += frame.estimates[e] == id_of[t] &&
                   frame.similarity(Eigen::Index(t), Eigen::Index(e)) >= kSameObjectSimilarity;
        }
      }
    }
    best = std::max(best, count);
  } while (std::ranges::next_permutation(id_of).found);
  return best;
}

}  // namespace

TEST_CASE("two objects that exchange their ids half way: IDF1 is a half, and two switches") {
  const auto frames = exchanged_half_way(8);
  CHECK(identity_scores(frames).f1() == Approx(0.5));
  const ClearScores clear = clear_scores(frames);
  CHECK(clear.switches == 2);
  CHECK(clear.type_switches == 2);
  CHECK(clear.accuracy() == Approx(1 - 2.0 / 16));
}

TEST_CASE("misses and phantoms lower MOTA and IDF1 alike") {
  std::vector<ComparedFrame> frames{compared_frame(2, {{1, 1}, {2, 2}}),
                                    compared_frame(2, {{1, 1}, {3, 0}})};
  const ClearScores clear = clear_scores(frames);
  CHECK(clear.misses == 1);
  CHECK(clear.false_positives == 1);
  CHECK(clear.switches == 0);
  CHECK(clear.accuracy() == Approx(0.5));
  CHECK(identity_scores(frames).f1() == Approx(2.0 * 3 / 8));
}

TEST_CASE("an estimate that is too far off stands for nothing") {
  const std::vector<ComparedFrame> frames{compared_frame(1, {{1, 1, 0.49}})};
  CHECK(identity_scores(frames).true_positives == 0);
  CHECK(clear_scores(frames).misses == 1);
}

TEST_CASE("a new id at an object's place is one switch, and none between types") {
  const std::vector<ComparedFrame> frames{compared_frame(1, {{1, 1}}), compared_frame(1, {}),
                                          compared_frame(1, {{2, 1}})};
  const ClearScores clear = clear_scores(frames);
  CHECK(clear.switches == 1);
  CHECK(clear.type_switches == 0);
}

TEST_CASE("IDF1's assignment of tracks is the best of all") {
  Random random(5);
  for (int trial = 0; trial < 40; ++trial) {
    std::vector<ComparedFrame> frames;
    for (int i = 0; i < 12; ++i) {
      std::vector<SeenAs> seen;
      for (std::uint64_t id = 1; id <= 4; ++id) {
        seen.push_back({id, std::size_t(random.uniform(0, 5)), random.uniform(0, 1)});
      }
      frames.push_back(compared_frame(4, seen));
    }
    CHECK(identity_scores(frames).true_positives == true_positives_by_trying(frames, 4));
  }
}

}  // namespace vantage::test
