#include "metrics/tracking/assignment.hpp"

#include <limits>

namespace vantage {
namespace {

/// Rows 1 … n to columns 1 … m of costs, n <= m; row and column 0 stand for none.
class AugmentingPaths {
 public:
  explicit AugmentingPaths(const Eigen::MatrixXd& cost)
      : cost_(cost),
        row_price_(std::size_t(cost.rows()) + 1, 0.0),
        column_price_(std::size_t(cost.cols()) + 1, 0.0),
        row_of_(std::size_t(cost.cols()) + 1, 0) {
    for (std::size_t row = 1; row < row_price_.size(); ++row) add(row);
  }

  /// Of each column; 0: none.
  const std::vector<std::size_t>& rows() const { return row_of_; }

 private:
  double reduced_cost(std::size_t row, std::size_t column) const {
    return cost_(Eigen::Index(row) - 1, Eigen::Index(column) - 1) - row_price_[row] -
           column_price_[column];
  }

  /// Dijkstra's search from the new row to a column that is free; then the path changes hands.
  void add(std::size_t new_row) {
    const std::size_t columns = column_price_.size();
    std::vector<double> distance(columns, std::numeric_limits<double>::infinity());
    std::vector<std::size_t> before(columns, 0);
    std::vector<bool> done(columns, false);
    row_of_[0] = new_row;
    std::size_t at = 0;
    while (row_of_[at] != 0) {
      done[at] = true;
      std::size_t next = 0;
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t column = 1; column < columns; ++column) {
        if (done[column]) continue;
        const double cost = reduced_cost(row_of_[at], column);
        if (cost < distance[column]) distance[column] = cost, before[column] = at;
        if (distance[column] < least) least = distance[column], next = column;
      }
      move_prices(least, done, distance);
      at = next;
    }
    for (; at != 0; at = before[at]) row_of_[at] = row_of_[before[at]];
  }

  void move_prices(double by, const std::vector<bool>& done, std::vector<double>& distance) {
    for (std::size_t column = 0; column < done.size(); ++column) {
      if (done[column]) {
        row_price_[row_of_[column]] += by;
        column_price_[column] -= by;
      } else {
        distance[column] -= by;
      }
    }
  }

  const Eigen::MatrixXd& cost_;
  std::vector<double> row_price_, column_price_;
  std::vector<std::size_t> row_of_;
};

}  // namespace

std::vector<std::optional<std::size_t>> best_assignment(const Eigen::MatrixXd& gains) {
  std::vector<std::optional<std::size_t>> columns(std::size_t(gains.rows()));
  if (gains.size() == 0) return columns;
  const bool wide = gains.rows() <= gains.cols();
  const Eigen::MatrixXd cost = wide ? Eigen::MatrixXd(-gains) : Eigen::MatrixXd(-gains.transpose());
  const AugmentingPaths paths(cost);
  for (std::size_t column = 1; column < paths.rows().size(); ++column) {
    if (paths.rows()[column] == 0) continue;
    std::size_t a = paths.rows()[column] - 1, b = column - 1;
    if (!wide) std::swap(a, b);
    if (gains(Eigen::Index(a), Eigen::Index(b)) > 0) columns[a] = b;
  }
  return columns;
}

}  // namespace vantage
