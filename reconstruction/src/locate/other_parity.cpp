#include <algorithm>
#include <cmath>
#include <set>

#include "locate/board_readings.hpp"

namespace vantage::reconstruction::detail {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// A square of the checkerboard.
struct Square {
  int column = 0, row = 0;
  auto operator<=>(const Square&) const = default;
};

/// A coordinate's values as multiples of their least distance.
struct Ruler {
  double start = 0, step = 0;
  int count = 0;  ///< values, from the first to the last one

  explicit Ruler(std::vector<double> values) {
    std::ranges::sort(values);
    const double alike = 1e-3 * (values.back() - values.front());
    start = values.front();
    for (std::size_t i = 1; i < values.size(); ++i) {
      const double gap = values[i] - values[i - 1];
      if (gap > alike && (step == 0 || gap < step)) step = gap;
    }
    if (step > 0) count = int(std::lround((values.back() - start) / step)) + 1;
  }
  double index(double value) const { return (value - start) / step; }
};

bool is_whole(double value) {
  return std::abs(value - std::round(value)) < 0.02;
}

/// The squares' order on the board: by rows, in the direction in which the list of markers goes.
std::vector<Square> squares_of(int columns, int rows, int parity, bool downwards) {
  std::vector<Square> squares;
  for (int r = 0; r < rows; ++r) {
    const int row = downwards ? rows - 1 - r : r;
    for (int column = 0; column < columns; ++column) {
      if ((column + row) % 2 == parity) squares.push_back({column, row});
    }
  }
  return squares;
}

}  // namespace

std::optional<std::vector<Points>> other_parity(std::span<const ObjectFeature> board) {
  constexpr std::size_t kFew = 4;
  std::vector<double> xs, ys;
  std::vector<Eigen::Vector3d> centres;
  for (const ObjectFeature& feature : board) {
    const auto* marker = std::get_if<Marker>(&feature.geometry);
    if (!marker) return std::nullopt;
    centres.push_back(marker->T_object_marker.translation());
    xs.push_back(centres.back().x());
    ys.push_back(centres.back().y());
  }
  if (centres.size() < kFew) return std::nullopt;
  const Ruler x(xs), y(ys);
  if (x.count < 2 || y.count < 2 || std::abs(x.step - y.step) > 0.02 * x.step) return std::nullopt;

  std::vector<Square> given;
  for (const Eigen::Vector3d& centre : centres) {
    const double column = x.index(centre.x()), row = y.index(centre.y());
    if (!is_whole(column) || !is_whole(row)) return std::nullopt;
    given.push_back({int(std::lround(column)), int(std::lround(row))});
  }
  const int parity = (given[0].column + given[0].row) % 2;
  const bool downwards = given.front().row > given.back().row;
  if (given != squares_of(x.count, y.count, parity, downwards)) return std::nullopt;

  const std::vector<Square> other = squares_of(x.count, y.count, 1 - parity, downwards);
  std::vector<Points> points;
  for (std::size_t i = 0; i < board.size(); ++i) {
    points.push_back(board[i].points());
    if (i >= other.size()) continue;  // a board of odd sides has one square more of one colour
    const Eigen::Vector3d shift(x.step * (other[i].column - given[i].column),
                                y.step * (other[i].row - given[i].row), 0);
    for (Eigen::Vector3d& point : points.back()) point += shift;
  }
  return points;
}

}  // namespace vantage::reconstruction::detail
