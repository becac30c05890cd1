// The assignment against trying all of them.

#include "metrics/tracking/assignment.hpp"

#include <doctest/doctest.h>

#include <algorithm>

#include "reference/random_scene.hpp"

namespace vantage::test {
namespace {

double best_by_trying(const Eigen::MatrixXd& gains, Eigen::Index row, std::vector<bool>& taken) {
  if (row == gains.rows()) return 0;
  double best = best_by_trying(gains, row + 1, taken);  // this row has none
  for (Eigen::Index column = 0; column < gains.cols(); ++column) {
    if (taken[std::size_t(column)]) continue;
    taken[std::size_t(column)] = true;
    best = std::max(best, gains(row, column) + best_by_trying(gains, row + 1, taken));
    taken[std::size_t(column)] = false;
  }
  return best;
}

Eigen::MatrixXd random_gains(Random& random) {
  const auto rows = Eigen::Index(random.uniform(0, 6)),
             columns = Eigen::Index(random.uniform(0, 6));
  Eigen::MatrixXd gains(rows, columns);
  for (double& gain : gains.reshaped()) gain = std::max(0.0, random.uniform(-0.5, 1));
  return gains;
}

}  // namespace

TEST_CASE("the assignment has the largest sum of all that there are") {
  Random random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const Eigen::MatrixXd gains = random_gains(random);
    CAPTURE(gains);
    const auto columns = best_assignment(gains);
    REQUIRE(columns.size() == std::size_t(gains.rows()));
    std::vector<bool> taken(std::size_t(gains.cols()), false);
    double sum = 0;
    for (std::size_t row = 0; row < columns.size(); ++row) {
      if (!columns[row]) continue;
      CHECK_FALSE(taken[*columns[row]]);
      taken[*columns[row]] = true;
      CHECK(gains(Eigen::Index(row), Eigen::Index(*columns[row])) > 0);
      sum += gains(Eigen::Index(row), Eigen::Index(*columns[row]));
    }
    std::vector<bool> none(std::size_t(gains.cols()), false);
    CHECK(sum == doctest::Approx(best_by_trying(gains, 0, none)));
  }
}

TEST_CASE("a nearer pair gives way where both are better off") {
  const Eigen::MatrixXd gains{{0.9, 0.8}, {0.85, 0}};
  const auto columns = best_assignment(gains);
  CHECK(columns[0] == 1);
  CHECK(columns[1] == 0);
}

}  // namespace vantage::test
