#include "metrics/plot/label_layout.hpp"

#include <algorithm>
#include <numeric>

namespace vantage {

std::vector<double> stacked(const std::vector<PagePoint>& points, const MarkCell& cell) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return points[a].x < points[b].x; });
  std::vector<double> y(points.size());
  std::vector<std::size_t> placed;
  for (const std::size_t i : order) {
    y[i] = points[i].y;
    // Each step up may bring the mark to others; it never comes back to those below.
    const auto in_the_way = [&](std::size_t other) {
      return points[i].x - points[other].x < cell.left + cell.right &&
             y[i] - y[other] < cell.height && y[other] - y[i] < cell.height;
    };
    for (auto other = std::ranges::find_if(placed, in_the_way); other != placed.end();
         other = std::ranges::find_if(placed, in_the_way)) {
      y[i] = y[*other] - cell.height;
    }
    placed.push_back(i);
  }
  return y;
}

}  // namespace vantage
