#include "evaluation/label_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vantage {
namespace {

constexpr int kDirections = 16;
constexpr std::array<double, 6> kDistances{12, 18, 24, 31, 40, 52};
constexpr double kBeside = 14;  // farther than this, a line is drawn

PlotBox box_around(double x, double y, double width, double height) {
  return {x - 0.5 * width, y - 0.5 * height, x + 0.5 * width, y + 0.5 * height};
}

}  // namespace

std::vector<LabelPlace> label_places(const std::vector<LabelledPoint>& points, double width,
                                     double height, double mark_radius, const PlotBox& page) {
  std::vector<PlotBox> taken;
  for (const LabelledPoint& p : points) {
    taken.push_back(box_around(p.x, p.y, 2 * mark_radius, 2 * mark_radius));
  }
  const auto free = [&](const PlotBox& box) {
    return box.within(page) &&
           std::ranges::none_of(taken, [&](const PlotBox& other) { return box.meets(other); });
  };
  std::vector<LabelPlace> places;
  for (const LabelledPoint& p : points) {
    LabelPlace place{p.x + kDistances.front(), p.y, false};
    bool found = false;
    for (std::size_t i = 0; i < kDistances.size() && !found; ++i) {
      for (int d = 0; d < kDirections && !found; ++d) {
        // Right, left, above, below first; then what lies between.
        const int turn = (d % 4) * 4 + std::array{0, 2, 1, 3}[std::size_t(d / 4)];
        const double angle = 2 * std::numbers::pi * turn / kDirections;
        const double x = p.x + kDistances[i] * std::cos(angle);
        const double y = p.y - kDistances[i] * std::sin(angle);
        found = free(box_around(x, y, width, height));
        if (found) place = {x, y, kDistances[i] > kBeside};
      }
    }
    taken.push_back(box_around(place.x, place.y, width, height));
    places.push_back(place);
  }
  return places;
}

}  // namespace vantage
