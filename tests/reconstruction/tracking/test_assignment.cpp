#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "reference/random_scene.hpp"
#include "support/scene_count.hpp"
#include "tracking/assignment.hpp"

namespace vantage::test {
namespace {

using reconstruction::detail::cheapest_assignment;

double sum_of(const Eigen::MatrixXd& costs, const std::vector<std::size_t>& columns) {
  double sum = 0;
  for (std::size_t row = 0; row < std::size_t(costs.rows()); ++row) {
    sum += costs(Eigen::Index(row), Eigen::Index(columns[row]));
  }
  return sum;
}

/// Tries every order of the columns.
double smallest_sum(const Eigen::MatrixXd& costs) {
  std::vector<std::size_t> columns(std::size_t(costs.cols()));
  std::iota(columns.begin(), columns.end(), std::size_t(0));
  double smallest = std::numeric_limits<double>::infinity();
  do {
    smallest = std::min(smallest, sum_of(costs, columns));
  } while (std::next_permutation(columns.begin(), columns.end()));
  return smallest;
}

}  // namespace

TEST_CASE("assignment: no order of the columns is cheaper, and no column is used twice") {
  Random random(1);
  for (std::uint32_t i = 0; i < scene_count(600); ++i) {
    CAPTURE(i);
    const int rows = int(random.uniform(1, 5.999)), more = int(random.uniform(0, 2.999));
    Eigen::MatrixXd costs(rows, rows + more);
    for (double& cost : costs.reshaped()) {
      cost = std::round(random.uniform(-5, 5));  // with ties
      if (random.uniform(0, 1) < 0.2) cost = std::numeric_limits<double>::infinity();
    }
    const double smallest = smallest_sum(costs);
    const auto columns = cheapest_assignment(costs);
    REQUIRE(columns.has_value() == (smallest < std::numeric_limits<double>::infinity()));
    if (!columns) continue;
    CHECK(sum_of(costs, *columns) == doctest::Approx(smallest));
    std::vector<std::size_t> sorted = *columns;
    std::ranges::sort(sorted);
    CHECK(std::ranges::adjacent_find(sorted) == sorted.end());
  }
}

TEST_CASE("assignment: nothing to assign is assigned") {
  const auto columns = cheapest_assignment(Eigen::MatrixXd(0, 3));
  REQUIRE(columns);
  CHECK(columns->empty());
}

}  // namespace vantage::test
