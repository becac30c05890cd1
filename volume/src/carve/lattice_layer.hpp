#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "carve/lattice_axis.hpp"
#include "grid/blocks.hpp"

namespace vantage::detail {

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
  std::uint64_t seen;     ///< and in front of its surface, as `DepthLattice::sees` has it
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

}  // namespace vantage::detail
