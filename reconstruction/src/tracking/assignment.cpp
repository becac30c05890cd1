#include "tracking/assignment.hpp"

#include <limits>

namespace vantage::reconstruction::detail {
namespace {

constexpr double kForbidden = std::numeric_limits<double>::infinity();
constexpr Eigen::Index kNone = -1;

/// Assigned rows and columns, with dual variables that keep all reduced costs from below zero.
struct Matching {
  std::vector<Eigen::Index> column_of, row_of;
  std::vector<double> row_price, column_price;
};

/// A shortest path in reduced costs from a free row to a free column.
struct Path {
  std::vector<double> length;           ///< to each column
  std::vector<Eigen::Index> before;     ///< the row before each column
  std::vector<char> done;               ///< columns whose length is final
  std::vector<Eigen::Index> rows = {};  ///< in the tree
  Eigen::Index end = kNone;             ///< kNone: there is no path
};

Path shortest_path(const Eigen::MatrixXd& costs, const Matching& matching, Eigen::Index start) {
  const std::size_t columns = std::size_t(costs.cols());
  Path path{std::vector<double>(columns, kForbidden), std::vector<Eigen::Index>(columns, kNone),
            std::vector<char>(columns, 0)};
  Eigen::Index row = start;
  double so_far = 0;
  while (true) {
    path.rows.push_back(row);
    std::size_t next = columns;
    for (std::size_t c = 0; c < columns; ++c) {
      if (path.done[c]) continue;
      const double step = costs(row, Eigen::Index(c)) - matching.row_price[std::size_t(row)] -
                          matching.column_price[c];
      if (so_far + step < path.length[c]) {
        path.length[c] = so_far + step;
        path.before[c] = row;
      }
      if (next == columns || path.length[c] < path.length[next]) next = c;
    }
    if (next == columns || path.length[next] == kForbidden) return path;
    so_far = path.length[next];
    path.done[next] = 1;
    if (matching.row_of[next] == kNone) {
      path.end = Eigen::Index(next);
      return path;
    }
    row = matching.row_of[next];
  }
}

void update_prices(const Path& path, Eigen::Index start, Matching& matching) {
  const double total = path.length[std::size_t(path.end)];
  matching.row_price[std::size_t(start)] += total;
  for (const Eigen::Index row : path.rows) {
    if (row == start) continue;
    const std::size_t column = std::size_t(matching.column_of[std::size_t(row)]);
    matching.row_price[std::size_t(row)] += total - path.length[column];
  }
  for (std::size_t c = 0; c < path.done.size(); ++c) {
    if (path.done[c]) matching.column_price[c] -= total - path.length[c];
  }
}

void augment(const Path& path, Eigen::Index start, Matching& matching) {
  Eigen::Index column = path.end;
  while (true) {
    const Eigen::Index row = path.before[std::size_t(column)];
    matching.row_of[std::size_t(column)] = row;
    std::swap(matching.column_of[std::size_t(row)], column);
    if (row == start) return;
  }
}

}  // namespace

std::optional<std::vector<std::size_t>> cheapest_assignment(const Eigen::MatrixXd& costs) {
  const std::size_t rows = std::size_t(costs.rows()), columns = std::size_t(costs.cols());
  Matching matching{std::vector<Eigen::Index>(rows, kNone),
                    std::vector<Eigen::Index>(columns, kNone), std::vector<double>(rows, 0),
                    std::vector<double>(columns, 0)};
  for (std::size_t row = 0; row < rows; ++row) {
    const Path path = shortest_path(costs, matching, Eigen::Index(row));
    if (path.end == kNone) return std::nullopt;
    update_prices(path, Eigen::Index(row), matching);
    augment(path, Eigen::Index(row), matching);
  }
  return std::vector<std::size_t>(matching.column_of.begin(), matching.column_of.end());
}

}  // namespace vantage::reconstruction::detail
