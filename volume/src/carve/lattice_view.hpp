#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "carve/lattice_layer.hpp"
#include "grid/grid_frame.hpp"
#include "grid/hierarchical_z.hpp"
#include "vantage/raycore/advanced/visibility_mesh.hpp"
#include "vantage/raycore/detail/box_projector.hpp"

namespace vantage::volume::detail {

/// What a lattice says of a block's voxels.
struct BlockSeen {
  BlockBits covered;  ///< the centre is in the lattice's rectangle of pixels
  BlockBits seen;     ///< and in front of its surface
};

/// What it says of all voxels of a range; nothing where they differ, or might.
struct RangeSeen {
  std::optional<bool> covered, seen;
};

/// A depth lattice prepared for comparison with voxels, in the grid's frame. Immutable.
///
/// Single voxels are compared in double, as `VisibilityMesh::sees` does, and get the same answer
/// but for rounding; ranges are decided by certified bounds.
class LatticeView {
 public:
  /// @param lattice valid.
  /// @param T_grid_world where the grid's frame is.
  LatticeView(const VisibilityMesh& lattice, const Pose& T_grid_world, const GridFrame& frame);

  RangeSeen ask(const CellRange& blocks) const;
  BlockSeen compare(const Eigen::Vector3i& block) const;

  /// How far inside of the seen volume a point of the grid's frame is, metres; negative outside.
  /// Exact at the triangles' planes, at the rectangle's borders, and at those of holes; farther
  /// away only the sign is, and near edges the nearest of these planes counts.
  double depth_in_seen_m(const Eigen::Vector3d& p_grid) const;

 private:
  struct BoxOnImage;

  void build_pyramids(const VisibilityMesh& lattice);
  LatticeCells cells_under(const ImageRect& rect) const;
  std::optional<bool> ask_planes(const LatticeCells& cells, const Extent& box,
                                 double margin_m) const;
  bool has_cell(int i, int j) const;
  double distance_to_sides_m(const Eigen::Array2d& pixel, const Eigen::Array2d& metres_per_pixel,
                             int i, int j) const;
  bool planes_of_cell(int i, int j, Eigen::Vector3d (&planes)[2]) const;

  const GridFrame& frame_;
  LatticeAxis columns_, rows_;
  std::vector<double> inverse_;  ///< 1 / depth by vertex
  PinholeCamera camera_;         ///< its pixels are the axes' units
  BoxProjector projector_;
  Eigen::Matrix3d image_grid_;              ///< to (u z, v z, z), from the camera's centre
  MinPyramid nearest_, negative_farthest_;  ///< by cell; ∓infinity where there is none
};

}  // namespace vantage::volume::detail
