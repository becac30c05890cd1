#pragma once

#include <limits>
#include <utility>
#include <vector>

namespace vantage::reconstruction::detail {

/// A linear programme with unknowns that are not negative: the least cost of them at which every
/// row's sum lies within its bounds.
class LinearProgram {
 public:
  using Entries = std::vector<std::pair<int, double>>;  ///< row and coefficient
  static constexpr double kUnbounded = std::numeric_limits<double>::max();

  /// @returns the row's number, from 0.
  int add_row(double lowest, double highest);

  /// @returns the unknown's number, from 0.
  int add_unknown(double cost, const Entries& entries);

  /// The unknowns of a least cost; empty if there is no solution. Deterministic.
  std::vector<double> solve() const;

 private:
  std::vector<double> lowest_, highest_;  // of rows
  std::vector<double> costs_, values_;
  std::vector<int> starts_ = {0}, rows_;
};

}  // namespace vantage::reconstruction::detail
