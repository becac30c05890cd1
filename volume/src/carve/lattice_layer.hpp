#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "grid/blocks.hpp"

namespace vantage::volume::detail {

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
        per_pixel(std::min(1.0, kMaxUnits / (double(pixels.back()) - first))) {
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
  static constexpr double kMaxUnits = 16000;
};

/// 8 × 8 voxels of a block, those of one x: voxel 8 y + z.
inline constexpr int kLayerVoxels = kBlockSide * kBlockSide;

/// A layer's voxel centres on the image, in an axis' units: (u z, v z, z) of the first one, and
/// what a step along y and along z adds.
struct LayerOnImage {
  Eigen::Vector3d first, step_y, step_z;
};

/// One bit for each voxel of a layer.
struct LayerSeen {
  std::uint64_t covered;  ///< the centre is in the lattice's rectangle
  std::uint64_t seen;     ///< and in front of its surface, as `VisibilityMesh::sees` has it
};

/// Cells [i0, i1] × [j0, j1] of a lattice.
struct LatticeCells {
  int i0, i1, j0, j1;
  int count() const { return (i1 - i0 + 1) * (j1 - j0 + 1); }
};

/// @param cells hold every centre that is in the lattice's rectangle.
/// @param inverse_depth 1 / depth by vertex, row by row; NaN where it is unknown.
LayerSeen compare_layer(const LatticeAxis& columns, const LatticeAxis& rows,
                        const LatticeCells& cells, const double* inverse_depth,
                        const LayerOnImage& layer);

}  // namespace vantage::volume::detail
