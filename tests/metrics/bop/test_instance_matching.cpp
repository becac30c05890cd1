#include "metrics/bop/instance_matching.hpp"

#include <doctest/doctest.h>

#include "support/non_finite.hpp"

namespace vantage {
namespace {

using Matches = std::vector<std::optional<Match>>;

bool matched(const std::optional<Match>& match, std::size_t truth, double error) {
  return match && match->truth == truth && match->error == error;
}

}  // namespace

TEST_CASE("each estimate takes the nearest true object that is free") {
  const Eigen::MatrixXd errors{{0.1, 0.3}, {0.2, 0.4}};
  const Matches matches = match_instances(errors, std::vector{1.0, 1.0}, 1);
  CHECK(matched(matches[0], 0, 0.1));
  CHECK(matched(matches[1], 1, 0.4));
}

TEST_CASE("the higher score chooses first, even if another one would fit better") {
  const Eigen::MatrixXd errors{{0.1}, {0.2}};
  const Matches matches = match_instances(errors, std::vector{0.5, 0.9}, 1);
  CHECK_FALSE(matches[0]);
  CHECK(matched(matches[1], 0, 0.2));
}

TEST_CASE("an error at the threshold is too large, and other types are never matched") {
  const Eigen::MatrixXd errors{{0.5, test::kInfinity}, {test::kInfinity, 0.4}};
  const Matches matches = match_instances(errors, std::vector{1.0, 1.0}, 0.5);
  CHECK_FALSE(matches[0]);
  CHECK(matched(matches[1], 1, 0.4));
  const Matches all = match_instances(errors, std::vector{1.0, 1.0}, test::kInfinity);
  CHECK(matched(all[0], 0, 0.5));
}

TEST_CASE("of equal errors the earlier object is taken, of equal scores the earlier estimate") {
  const Eigen::MatrixXd errors{{0.1, 0.1}, {0.1, 0.1}, {0.1, 0.1}};
  const Matches matches = match_instances(errors, std::vector{1.0, 1.0, 1.0}, 1);
  CHECK(matched(matches[0], 0, 0.1));
  CHECK(matched(matches[1], 1, 0.1));
  CHECK_FALSE(matches[2]);
}

TEST_CASE("nothing estimated, or nothing there") {
  CHECK(match_instances(Eigen::MatrixXd(0, 3), {}, 1).empty());
  const Matches matches = match_instances(Eigen::MatrixXd(2, 0), std::vector{1.0, 1.0}, 1);
  REQUIRE(matches.size() == 2);
  CHECK_FALSE(matches[0]);
}

TEST_CASE("only the objects that count are counted as found") {
  const Matches matches{Match{0, 0.1}, std::nullopt, Match{2, 0.1}};
  CHECK(found(matches, {true, true, true}) == 2);
  CHECK(found(matches, {false, true, true}) == 1);
}

}  // namespace vantage
