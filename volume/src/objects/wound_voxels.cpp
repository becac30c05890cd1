#include "objects/wound_voxels.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "grid/grid_frame.hpp"
#include "objects/scan_lines.hpp"

namespace vantage::volume::detail {
namespace {

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

}  // namespace

std::pair<std::uint64_t, std::uint64_t> fill_wound(const PlacedMesh& placed,
                                                   const PlacedTriangles& mesh,
                                                   const CellRange& voxels, double voxel_size_m,
                                                   const StopToken& stop, BlockBuffer& buffer) {
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
  // Slice by slice of blocks, which no two threads share.
  tbb::parallel_for(voxels.first.x() / kBlockSide, (voxels.last.x() - 1) / kBlockSide + 1,
                    fill_slice);
  return {wound.load(), ambiguous.load()};
}

}  // namespace vantage::volume::detail
