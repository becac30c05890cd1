#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vantage::detail {

/// Finds the cell of a lattice's axis that a coordinate lies in, in a few steps of arithmetic.
///
/// Coordinates count from the first vertex, in units of which few thousand cover the axis: pixels,
/// but for absurdly long axes. A table has for every unit the first cell to look at.
struct LatticeAxis {
  double first;                      ///< the first vertex in pixels
  double per_pixel;                  ///< units
  double length;                     ///< units
  std::vector<double> vertices;      ///< units, from 0
  std::vector<double> per_cell;      ///< 1 / its length, by cell
  std::vector<std::int32_t> starts;  ///< by unit: the last vertex of an earlier unit, 0 if none
  int steps = 0;                     ///< how many vertices share a unit at the most

  explicit LatticeAxis(std::span<const float> pixels)
      : first(double(pixels.front())),
        per_pixel(std::min(1.0, kMostUnits / (double(pixels.back()) - first))) {
    for (const float pixel : pixels) vertices.push_back((double(pixel) - first) * per_pixel);
    length = vertices.back();
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      per_cell.push_back(1 / (vertices[i] - vertices[i - 1]));
    }
    starts.resize(std::size_t(length) + 1);
    std::size_t next = 0;
    for (std::size_t unit = 0; unit < starts.size(); ++unit) {
      const std::size_t begin = next;
      starts[unit] = std::int32_t(std::max(begin, std::size_t(1)) - 1);
      while (next < vertices.size() && std::size_t(vertices[next]) == unit) ++next;
      steps = std::max(steps, int(next - begin));
    }
  }

  int cells() const { return int(vertices.size()) - 1; }

  /// The cell of a coordinate, in units; that at the end for one beyond it.
  int cell(double at) const {
    const double inside = std::clamp(at, 0.0, length);
    int cell = starts[std::size_t(inside)];
    while (cell + 1 < cells() && vertices[std::size_t(cell) + 1] <= inside) ++cell;
    return std::min(cell, cells() - 1);
  }

 private:
  static constexpr double kMostUnits = 16000;
};

}  // namespace vantage::detail
