#include "vantage/reconstruction/detector_recall.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace vantage {
namespace {

constexpr std::array kSidesPx{8.0, 10.0, 12.0, 14.0, 16.0, 20.0, 24.0, 32.0, 48.0};
constexpr std::array kAnglesDeg{0.0, 30.0, 45.0, 60.0, 70.0, 75.0, 80.0, 85.0};

/// Found of so many markers, for each side (row) and angle (column).
constexpr int kTrials = 20;
constexpr int kFound[kSidesPx.size()][kAnglesDeg.size()] = {
    {0, 1, 0, 0, 0, 0, 0, 0},     {7, 4, 0, 0, 0, 0, 0, 0},       {11, 7, 3, 2, 0, 0, 0, 0},
    {15, 13, 13, 0, 0, 0, 0, 0},  {17, 16, 15, 2, 0, 0, 0, 0},    {20, 19, 17, 12, 0, 0, 0, 0},
    {20, 20, 20, 18, 9, 0, 0, 0}, {20, 20, 20, 20, 17, 11, 0, 0}, {20, 20, 20, 20, 20, 20, 6, 0}};

/// Where a value lies among the table's: the lower one, and the share of the way to the next.
struct Cell {
  std::size_t index = 0;
  double share = 0;
};

template <std::size_t N>
Cell cell_of(double value, const std::array<double, N>& values) {
  if (value <= values.front()) return {};
  if (value >= values.back()) return {N - 2, 1};
  std::size_t i = 0;
  while (value > values[i + 1]) ++i;
  return {i, (value - values[i]) / (values[i + 1] - values[i])};
}

}  // namespace

double detector_recall(double side_px, double angle_rad) {
  const double angle_deg = angle_rad * 180 / std::numbers::pi;
  if (!(side_px >= kSidesPx.front()) || !(angle_deg < kAnglesDeg.back())) return 0;
  const Cell row = cell_of(side_px, kSidesPx), column = cell_of(angle_deg, kAnglesDeg);
  const auto at = [&](std::size_t r, std::size_t c) { return double(kFound[r][c]) / kTrials; };
  return std::lerp(
      std::lerp(at(row.index, column.index), at(row.index, column.index + 1), column.share),
      std::lerp(at(row.index + 1, column.index), at(row.index + 1, column.index + 1), column.share),
      row.share);
}

}  // namespace vantage
