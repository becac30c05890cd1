#pragma once

#include <vector>

namespace vantage {

/// A point on a page, y down.
struct PagePoint {
  double x = 0, y = 0;
};

/// What a mark and its label take up: so far to the left and to the right of the mark's middle, and
/// half the height above and below it.
struct MarkCell {
  double left = 0, right = 0, height = 0;
};

/// For each point the y of its mark: the point's own where nothing is in the way, else on top of
/// the marks that it would cover. No two cells overlap. From left to right; of two points with one
/// x, the first in the list comes first.
std::vector<double> stacked(const std::vector<PagePoint>& points, const MarkCell& cell);

}  // namespace vantage
