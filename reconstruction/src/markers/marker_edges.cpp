#include "markers/marker_edges.hpp"

#include <array>

namespace vantage::reconstruction::detail {
namespace {

bool is_black(const MarkerCells& cells, int column, int row) {
  const bool outside = column < 0 || row < 0 || column >= cells.side || row >= cells.side;
  return !outside && !cells.white[std::size_t(row * cells.side + column)];
}

/// The edges of one black cell, clockwise.
void add_edges(const MarkerCells& cells, int column, int row, std::vector<MarkerEdge>& edges) {
  constexpr std::array<std::array<int, 2>, 4> kBeside = {{{0, -1}, {1, 0}, {0, 1}, {-1, 0}}};
  constexpr std::array<std::array<int, 2>, 4> kCorner = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  const auto corner = [&](std::size_t i) -> Eigen::Vector2d {
    const Eigen::Vector2d at(column + kCorner[i][0], row + kCorner[i][1]);
    return (2.0 / cells.side * at).array() - 1;
  };
  for (std::size_t i = 0; i < 4; ++i) {
    if (is_black(cells, column + kBeside[i][0], row + kBeside[i][1])) continue;
    edges.push_back({corner(i), corner((i + 1) % 4)});
  }
}

}  // namespace

std::vector<MarkerEdge> marker_edges(const MarkerCells& cells) {
  std::vector<MarkerEdge> edges;
  for (int row = 0; row < cells.side; ++row) {
    for (int column = 0; column < cells.side; ++column) {
      if (is_black(cells, column, row)) add_edges(cells, column, row, edges);
    }
  }
  return edges;
}

}  // namespace vantage::reconstruction::detail
