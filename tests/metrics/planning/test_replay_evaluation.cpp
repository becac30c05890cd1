#include "metrics/planning/replay_evaluation.hpp"

#include <doctest/doctest.h>

#include "metrics/planning/replay_tables.hpp"

namespace vantage::test {
namespace {

/// Gains in halves and quarters, so that their means are exact.
ReplayPair pair_with(const std::vector<double>& real_gains, std::vector<std::size_t> picks) {
  ReplayPair pair{.frames = {3, 9}, .shadow_m3 = 8, .views = {}, .picks = std::move(picks)};
  for (std::size_t i = 0; i < real_gains.size(); ++i) {
    pair.views.push_back({.frame = int(10 * i),
                          .predicted_gain_m3 = 2 * real_gains[i],
                          .real_gain_m3 = real_gains[i],
                          .scores = {1.0, 2.0},
                          .expected_gain_m3 = 1.5 * real_gains[i]});
  }
  return pair;
}

ReplayEvaluation two_pairs() {
  return {{"voxel", "mesh"}, {pair_with({1, 4, 2, 1}, {1, 2}), pair_with({0.5, 0.5, 0}, {0, 2})}};
}

}  // namespace

TEST_CASE("what a pick is worth beside the best and the mean of all views") {
  const ReplayPair pair = pair_with({1, 4, 2, 1}, {2});
  CHECK(best_view(pair).frame == 10);
  CHECK(mean_gain_m3(pair) == 2);
  const auto worth = worth_of(pair, 0);
  REQUIRE(worth);
  CHECK(worth->share_of_best == 0.5);
  CHECK(worth->times_mean == 1);
  CHECK(worth->rank == 2);
}

TEST_CASE("of equally good views all have the same rank, and the first is called the best") {
  const ReplayPair pair = pair_with({1, 3, 3, 2}, {1, 2, 3});
  CHECK(best_view(pair).frame == 10);
  CHECK(worth_of(pair, 0)->rank == 1);
  CHECK(worth_of(pair, 1)->rank == 1);
  CHECK(worth_of(pair, 2)->rank == 3);
}

TEST_CASE("means over the pairs, by method") {
  const ReplayEvaluation evaluation = two_pairs();
  const auto voxel = replay_means(evaluation, 0), mesh = replay_means(evaluation, 1);
  REQUIRE(voxel);
  REQUIRE(mesh);
  CHECK(voxel->pairs == 2);
  CHECK(voxel->share_of_best == 1);
  CHECK(voxel->times_mean == doctest::Approx((2 + 1.5) / 2));
  CHECK(voxel->rank == 1);
  CHECK(voxel->real_gain_m3 == 2.25);
  CHECK(voxel->predicted_gain_m3 == 4.5);
  CHECK(mesh->share_of_best == 0.25);
  CHECK(mesh->min_share_of_best == 0);
  CHECK(mesh->times_mean == 0.5);
  CHECK(mesh->rank == 2.5);
  // A blind choice: 2 of 4, and 1/3 of 0.5.
  CHECK(*blind_share_of_best(evaluation) == doctest::Approx((0.5 + 2.0 / 3) / 2));
}

TEST_CASE("a pair of which nothing is revealed does not count for a method") {
  ReplayEvaluation evaluation{{"voxel"}, {pair_with({0, 0}, {1})}};
  CHECK_FALSE(worth_of(evaluation.pairs[0], 0));
  CHECK_FALSE(replay_means(evaluation, 0));
  CHECK_FALSE(blind_share_of_best(evaluation));
  CHECK(table_text(replay_tables(evaluation)[0]).find("–") != std::string::npos);

  evaluation.pairs.push_back(pair_with({2, 1}, {1}));
  CHECK(replay_means(evaluation, 0)->pairs == 1);
  CHECK(replay_means(evaluation, 0)->share_of_best == 0.5);
  CHECK(*blind_share_of_best(evaluation) == 0.75);
}

TEST_CASE("tables: a line for each pair and method, and means with a blind choice beside them") {
  const auto tables = replay_tables(two_pairs());
  REQUIRE(tables.size() == 3);
  CHECK(tables[1].title.find("mesh") != std::string::npos);
  CHECK(tables[0].rows.size() == 2);
  CHECK(tables[1].rows[0].cells == std::vector<std::string>{"3, 9", "8.00000", "10", "4.00000",
                                                            "2.00000", "20", "4.00000", "3.00000",
                                                            "2.00000", "50.0 %", "×1.00", "2"});
  REQUIRE(tables[2].rows.size() == 3);
  CHECK(tables[2].rows[0].cells == std::vector<std::string>{"voxel", "4.50000", "3.37500",
                                                            "2.25000", "100.0 %", "100.0 %",
                                                            "×1.75", "1.0"});
  CHECK(tables[2].rows[2].cells[4] == "58.3 %");
  CHECK(tables[2].note.find("Rank correlation") != std::string::npos);
  for (const ReportTable& table : tables) CHECK_FALSE(table_text(table).empty());
}

TEST_CASE("expected gains that order the frames as the real ones do correlate fully") {
  CHECK(expected_rank_correlation(two_pairs()).value() == doctest::Approx(1));
  ReplayEvaluation turned = two_pairs();
  for (ReplayPair& pair : turned.pairs) {
    for (ReplayView& view : pair.views) view.expected_gain_m3 = 10 - view.real_gain_m3;
  }
  CHECK(expected_rank_correlation(turned).value() == doctest::Approx(-1));
  // Ranks 2, 0, 1 against 0, 1, 2.
  ReplayEvaluation one{{"voxel"}, {pair_with({1, 2, 3}, {0})}};
  for (std::size_t i = 0; i < 3; ++i) one.pairs[0].views[i].expected_gain_m3 = double((i + 2) % 3);
  CHECK(expected_rank_correlation(one).value() == doctest::Approx(-0.5));
  for (ReplayView& view : one.pairs[0].views) view.expected_gain_m3 = 1;
  CHECK_FALSE(expected_rank_correlation(one));
}

}  // namespace vantage::test
