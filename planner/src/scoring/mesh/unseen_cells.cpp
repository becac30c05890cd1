#include "scoring/mesh/unseen_cells.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>

namespace vantage::planner::detail {
namespace {

constexpr int kCellVoxels = 4;  // along an edge

/// The voxels of a cell that may hold something unseen.
using VoxelBox = Eigen::AlignedBox3i;

/// Cells around a grid's voxels and the layer beside them.
class CellGrid {
 public:
  explicit CellGrid(const Eigen::Vector3i& voxels)
      : size_(cell_of(voxels) + Eigen::Vector3i::Ones()), cells_(std::size_t(size_.prod())) {}

  /// Takes in a voxel, and those next to it, as `shell_around_shadow` does.
  void add(const Eigen::Vector3i& voxel) {
    const Eigen::Vector3i low = voxel - Eigen::Vector3i::Ones(),
                          high = voxel + Eigen::Vector3i::Ones();
    if (cell_of(low) == cell_of(high)) {
      at(low).extend(low).extend(high);
      return;
    }
    for (int corner = 0; corner < 8; ++corner) {
      const Eigen::Vector3i there((corner & 1 ? high : low).x(), (corner & 2 ? high : low).y(),
                                  (corner & 4 ? high : low).z());
      at(there).extend(there);
    }
  }

  const std::vector<VoxelBox>& cells() const { return cells_; }

 private:
  /// Counted from the cell of the layer before the grid's first voxels.
  static Eigen::Vector3i cell_of(const Eigen::Vector3i& voxel) {
    return (voxel.array() + kCellVoxels) / kCellVoxels;
  }
  VoxelBox& at(const Eigen::Vector3i& voxel) {
    const Eigen::Vector3i cell = cell_of(voxel);
    return cells_[std::size_t((cell.x() * size_.y() + cell.y()) * size_.z() + cell.z())];
  }

  Eigen::Vector3i size_;
  std::vector<VoxelBox> cells_;
};

Extent extent_of(const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
  return {0.5 * (min + max), 0.5 * (max - min)};
}

/// Columns [first, last] of rows [first, last].
struct TileRect {
  int first_column, last_column, first_row, last_row;
};

TileRect tiles_under(const ImageRect& rect, const Intrinsics& k) {
  const auto tile = [](double pixel, int size) {
    return int(std::clamp(pixel, 0.0, double(size - 1))) / PixelTile::kSide;
  };
  return {tile(rect.u0 - 0.5, k.width), tile(rect.u1 + 1.5, k.width), tile(rect.v0 - 0.5, k.height),
          tile(rect.v1 + 1.5, k.height)};
}

}  // namespace

UnseenCells::UnseenCells(const SeenWorld& world) {
  if (world.opened == nullptr) {
    cells_.push_back(extent_of(world.work_area.min(), world.work_area.max()));
    return;
  }
  const GridGeometry& geometry = world.opened->geometry();
  CellGrid grid(geometry.size());
  const Points centres = world.opened->centres(VoxelState::shadow);
  const PointsView points = centres;
  for (std::size_t i = 0; i < points.size; ++i) {
    grid.add(*geometry.voxel_at(points[i].cast<double>()));
  }
  for (const VoxelBox& cell : grid.cells()) {
    if (cell.isEmpty()) continue;
    const Eigen::Vector3i end = cell.max() + Eigen::Vector3i::Ones();
    cells_.push_back(extent_of(geometry.corner(cell.min()), geometry.corner(end)));
  }
}

UnseenTiles UnseenCells::tiles(const PinholeCamera& view) const {
  const Intrinsics& k = view.intrinsics();
  const BoxProjector projector(view);
  const int columns = (k.width + PixelTile::kSide - 1) / PixelTile::kSide;
  const int rows = (k.height + PixelTile::kSide - 1) / PixelTile::kSide;
  std::vector<std::uint8_t> shown(std::size_t(columns) * std::size_t(rows));
  UnseenTiles result;
  for (const Extent& cell : cells_) {
    const BoxInView box = projector.project(cell, projector.margin_m(cell));
    if (box.coverage == Coverage::none) continue;
    result.farthest_m = std::max(result.farthest_m, box.z_max);
    const TileRect under = tiles_under(box.rect, k);
    for (int row = under.first_row; row <= under.last_row; ++row) {
      const auto begin = shown.begin() + row * columns;
      std::fill(begin + under.first_column, begin + under.last_column + 1, 1);
    }
  }
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (shown[i] == 0) continue;
    result.tiles.push_back(
        {std::uint16_t(i % std::size_t(columns)), std::uint16_t(i / std::size_t(columns))});
  }
  return result;
}

}  // namespace vantage::planner::detail
