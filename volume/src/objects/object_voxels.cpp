#include "objects/object_voxels.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "objects/block_buffer.hpp"
#include "objects/scan_lines.hpp"
#include "objects/triangle_box.hpp"
#include "objects/wound_voxels.hpp"

namespace vantage::volume::detail {
namespace {

struct Bounds {
  Eigen::Vector3d low, high;

  explicit Bounds(const std::array<Eigen::Vector3d, 3>& corners)
      : low(corners[0].cwiseMin(corners[1]).cwiseMin(corners[2])),
        high(corners[0].cwiseMax(corners[1]).cwiseMax(corners[2])) {}
  explicit Bounds(const PlacedTriangles& mesh)
      : low(Eigen::Vector3d::Constant(std::numeric_limits<double>::max())), high(-low) {
    for (const Eigen::Vector3f& p : mesh.vertices) {
      low = low.cwiseMin(p.cast<double>());
      high = high.cwiseMax(p.cast<double>());
    }
  }
};

/// The cells of a size that a closed box touches, widened by a millionth of a cell.
CellRange cells_touched(const Bounds& bounds, double cell_size_m, const CellRange& within) {
  CellRange cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.first[axis] = floor_to_int(bounds.low[axis] / cell_size_m - 1e-6);
    cells.last[axis] = floor_to_int(bounds.high[axis] / cell_size_m + 1e-6) + 1;
  }
  return cells.within(within);
}

std::array<Eigen::Vector3d, 3> corners_of(const PlacedTriangles& mesh, std::size_t triangle) {
  return {mesh.corner(triangle, 0).cast<double>(), mesh.corner(triangle, 1).cast<double>(),
          mesh.corner(triangle, 2).cast<double>()};
}

/// Calls `visit` for the cells that a mesh's surface touches, more than once for some.
template <class Visit>
void for_each_cell_touched(const PlacedTriangles& mesh, double cell_size_m, const CellRange& within,
                           const Visit& visit) {
  const Eigen::Vector3d half = Eigen::Vector3d::Constant((0.5 + 1e-6) * cell_size_m);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::array<Eigen::Vector3d, 3> corners = corners_of(mesh, t);
    const CellRange cells = cells_touched(Bounds(corners), cell_size_m, within);
    if (cells.empty()) continue;
    const bool one = cells.size() == Eigen::Vector3i::Ones();
    cells.for_each([&](const Eigen::Vector3i& cell) {
      const Eigen::Vector3d centre =
          cell_size_m * (cell.cast<double>() + Eigen::Vector3d::Constant(0.5));
      if (one || triangle_touches_box(corners, centre, half)) visit(cell);
    });
  }
}

void fill_inside(const PlacedTriangles& mesh, Closure closure, const CellRange& voxels,
                 double voxel_size_m, BlockBuffer& buffer) {
  std::vector<Crossing> crossings = scan_line_crossings(mesh, voxels, voxel_size_m);
  std::sort(crossings.begin(), crossings.end(), crosses_earlier);
  int winding = 0;
  for (std::size_t n = 0; n + 1 < crossings.size(); ++n) {
    const Crossing &here = crossings[n], &next = crossings[n + 1];
    winding += closure == Closure::oriented ? here.sign : 1;
    if (here.i != next.i || here.j != next.j) {
      winding = 0;
      continue;
    }
    const bool inside = closure == Closure::oriented ? winding != 0 : winding % 2 != 0;
    if (!inside) continue;
    const int first = std::max(first_centre_above(here.z, voxel_size_m), voxels.first.z());
    const int last = std::min(first_centre_above(next.z, voxel_size_m), voxels.last.z());
    for (int k = first; k < last; ++k) buffer.set({here.i, here.j, k});
  }
}

void fill_open(const PlacedMesh& placed, const PlacedTriangles& mesh, const CellRange& voxels,
               double voxel_size_m, const StopToken& stop, BlockBuffer& buffer,
               ObjectVoxels& counts) {
  std::tie(counts.wound, counts.ambiguous) =
      fill_wound(placed, mesh, voxels, voxel_size_m, stop, buffer);
  const PlacedTriangles sheets(placed.topology->solid->vertices, placed.topology->sheets,
                               placed.T_grid_mesh);
  for_each_cell_touched(sheets, voxel_size_m, voxels,
                        [&](const Eigen::Vector3i& voxel) { buffer.set(voxel); });
}

}  // namespace

ObjectVoxels object_voxels(const PlacedMesh& placed, const BlockLayout& layout, double voxel_size_m,
                           const StopToken& stop) {
  const MeshTopology& topology = *placed.topology;
  const PlacedTriangles mesh = topology.solid == nullptr
                                   ? PlacedTriangles(placed)
                                   : PlacedTriangles(topology.solid->vertices,
                                                     topology.solid->triangles, placed.T_grid_mesh);
  const CellRange voxels = cells_touched(Bounds(mesh), voxel_size_m, layout.voxels());
  if (mesh.triangles.empty() || voxels.empty()) return {};
  BlockBuffer buffer(layout, voxels);
  ObjectVoxels counts;
  if (topology.closure == Closure::open) {
    fill_open(placed, mesh, voxels, voxel_size_m, stop, buffer, counts);
  } else {
    fill_inside(mesh, topology.closure, voxels, voxel_size_m, buffer);
  }
  counts.blocks = buffer.finish().blocks;
  return counts;
}

SurfaceOctants surface_octants(const PlacedTriangles& mesh, const BlockLayout& layout,
                               double voxel_size_m) {
  const double size_m = kOctantSide * voxel_size_m;
  const CellRange all{2 * layout.blocks().first, 2 * layout.blocks().last};
  const CellRange octants = cells_touched(Bounds(mesh), size_m, all);
  if (mesh.triangles.empty() || octants.empty()) return {};
  const CellRange blocks{octants.first / 2, (octants.last.array() + 1) / 2};
  std::vector<std::uint8_t> marks(blocks.count());
  for_each_cell_touched(mesh, size_m, octants, [&](const Eigen::Vector3i& octant) {
    marks[index_in(blocks, octant / 2)] |= std::uint8_t(1u << octant_in_block(octant));
  });
  SurfaceOctants result;
  blocks.for_each([&](const Eigen::Vector3i& block) {
    const std::uint8_t mark = marks[index_in(blocks, block)];
    if (mark != 0) result.blocks.push_back({layout.index(block), mark});
  });
  return result;
}

}  // namespace vantage::volume::detail
