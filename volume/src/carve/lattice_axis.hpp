#pragma once

#include <algorithm>
#include <span>
#include <vector>

namespace vantage::detail {

/// The columns or rows of a lattice. Coordinates count from the first one, in pixels, or in larger
/// units where an axis is longer than any image.
struct LatticeAxis {
  double first;                  ///< the first vertex in pixels
  double per_pixel;              ///< units
  double length;                 ///< units
  std::vector<double> vertices;  ///< units, from 0
  std::vector<double> per_cell;  ///< 1 / its length, by cell

  explicit LatticeAxis(std::span<const float> pixels)
      : first(double(pixels.front())),
        per_pixel(std::min(1.0, kMostUnits / (double(pixels.back()) - first))) {
    for (const float pixel : pixels) vertices.push_back((double(pixel) - first) * per_pixel);
    length = vertices.back();
    for (std::size_t i = 1; i < vertices.size(); ++i) {
      per_cell.push_back(1 / (vertices[i] - vertices[i - 1]));
    }
  }

  int cells() const { return int(per_cell.size()); }

  /// The cell of a coordinate, in units; that at the end for one beyond it.
  int cell(double at) const {
    return int(std::upper_bound(vertices.begin() + 1, vertices.end() - 1, at) - vertices.begin()) -
           1;
  }

 private:
  static constexpr double kMostUnits = 16000;
};

}  // namespace vantage::detail
