#include "objects/object_voxels.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <span>
#include <tuple>

#include "grid/grid_frame.hpp"
#include "objects/scan_lines.hpp"
#include "objects/triangle_box.hpp"

namespace vantage::volume::detail {
namespace {

/// Numbers the cells of a range, x slowest.
std::size_t index_in(const CellRange& range, const Eigen::Vector3i& cell) {
  const Eigen::Vector3i c = cell - range.first, n = range.size();
  return (std::size_t(c.x()) * std::size_t(n.y()) + std::size_t(c.y())) * std::size_t(n.z()) +
         std::size_t(c.z());
}

/// A box of blocks that is filled voxel by voxel, then stripped of the empty ones.
class BlockBuffer {
 public:
  BlockBuffer(const BlockLayout& layout, const CellRange& voxels)
      : layout_(layout),
        range_{voxels.first / kBlockSide, (voxels.last.array() + (kBlockSide - 1)) / kBlockSide},
        bits_(range_.count()) {}

  void set(const Eigen::Vector3i& voxel) {
    bits_[index_in(range_, voxel / kBlockSide)].set(offset_in_block(voxel));
  }

  ObjectVoxels finish() const {
    ObjectVoxels result;
    range_.for_each([&](const Eigen::Vector3i& block) {
      const BlockBits& bits = bits_[index_in(range_, block)];
      if (!bits.none()) result.blocks.push_back({layout_.index(block), bits});
    });
    return result;
  }

 private:
  const BlockLayout& layout_;
  CellRange range_;
  std::vector<BlockBits> bits_;
};

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

bool crosses_earlier(const Crossing& a, const Crossing& b) {
  return std::tuple(a.i, a.j, a.z) < std::tuple(b.i, b.j, b.z);
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

/// Fills by winding numbers, column by column. Between two crossings with the surface the number
/// changes smoothly: where its ends and its middle agree clearly, all of a stretch is as they are.
class WoundColumns {
 public:
  WoundColumns(const PlacedMesh& placed, const CellRange& voxels, double voxel_size_m,
               BlockBuffer& buffer)
      : winding_(*placed.topology->winding),
        T_mesh_grid_(placed.T_grid_mesh.inverse()),
        voxels_(voxels),
        voxel_size_m_(voxel_size_m),
        buffer_(buffer) {}

  /// @param crossings  all of this column, in ascending order.
  void fill(int i, int j, std::span<const Crossing> crossings) {
    int first = voxels_.first.z();
    for (const Crossing& crossing : crossings) {
      const int next =
          std::clamp(first_centre_above(crossing.z, voxel_size_m_), first, voxels_.last.z());
      fill_stretch({i, j, first}, next);
      first = next;
    }
    fill_stretch({i, j, first}, voxels_.last.z());
  }

  std::uint64_t wound = 0, ambiguous = 0;

 private:
  double number_at(const Eigen::Vector3i& voxel) const {
    const Eigen::Vector3d centre(centre_coordinate(voxel.x(), voxel_size_m_),
                                 centre_coordinate(voxel.y(), voxel_size_m_),
                                 centre_coordinate(voxel.z(), voxel_size_m_));
    return std::abs(winding_.at(T_mesh_grid_ * centre));
  }

  void fill_stretch(Eigen::Vector3i voxel, int end) {
    const int first = voxel.z(), last = end - 1;
    if (last < first) return;
    double low = std::numeric_limits<double>::max(), high = 0;
    for (const int k : {first, (first + last) / 2, last}) {
      const double number = number_at({voxel.x(), voxel.y(), k});
      low = std::min(low, number);
      high = std::max(high, number);
    }
    if (high < kOutside) return;
    for (; voxel.z() <= last; ++voxel.z()) {
      const double number = low > kClearlyInside ? low : number_at(voxel);
      if (number < kOutside) continue;
      ++wound;
      ambiguous += number < kClearlyInside ? 1 : 0;
      if (number > kInside) buffer_.set(voxel);
    }
  }

  static constexpr double kOutside = 0.25, kClearlyInside = 0.75;
  /// Winding numbers are off by less than 0.01: a large sheet has one half behind it.
  static constexpr double kInside = 0.51;

  const WindingNumber& winding_;
  Pose T_mesh_grid_;
  const CellRange& voxels_;
  double voxel_size_m_;
  BlockBuffer& buffer_;
};

/// Slice by slice of blocks, which no two threads share.
void fill_wound(const PlacedMesh& placed, const PlacedTriangles& mesh, const CellRange& voxels,
                double voxel_size_m, const StopToken& stop, BlockBuffer& buffer,
                ObjectVoxels& counts) {
  std::vector<Crossing> crossings = scan_line_crossings(mesh, voxels, voxel_size_m);
  std::sort(crossings.begin(), crossings.end(), crosses_earlier);
  std::atomic<std::uint64_t> wound = 0, ambiguous = 0;
  const auto fill_slice = [&](int slice) {
    WoundColumns columns(placed, voxels, voxel_size_m, buffer);
    const int first = std::max(voxels.first.x(), slice * kBlockSide);
    const int last = std::min(voxels.last.x(), (slice + 1) * kBlockSide);
    auto next = std::lower_bound(crossings.begin(), crossings.end(), first,
                                 [](const Crossing& c, int i) { return c.i < i; });
    for (int i = first; i < last && !stop.stop_requested(); ++i) {
      for (int j = voxels.first.y(); j < voxels.last.y(); ++j) {
        const auto start = next;
        while (next != crossings.end() && next->i == i && next->j == j) ++next;
        columns.fill(i, j, {start, next});
      }
    }
    wound += columns.wound;
    ambiguous += columns.ambiguous;
  };
  tbb::parallel_for(voxels.first.x() / kBlockSide, (voxels.last.x() - 1) / kBlockSide + 1,
                    fill_slice);
  counts.wound = wound;
  counts.ambiguous = ambiguous;
}

void fill_open(const PlacedMesh& placed, const PlacedTriangles& mesh, const CellRange& voxels,
               double voxel_size_m, const StopToken& stop, BlockBuffer& buffer,
               ObjectVoxels& counts) {
  fill_wound(placed, mesh, voxels, voxel_size_m, stop, buffer, counts);
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
