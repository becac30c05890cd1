#include "surface/voxel_faces.hpp"

#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <bit>
#include <iterator>
#include <span>
#include <utility>

#include "grid/state_grid_impl.hpp"
#include "surface/face_patches.hpp"

namespace vantage {
namespace volume::detail {
namespace {

/// Columns [begin, end) of rows [top, bottom).
struct Rectangle {
  int top, bottom, begin, end;
};

/// Merges the faces of one plane, row by row from the top.
class Merger {
 public:
  explicit Merger(std::span<const FacePatch> plane) {
    for (auto begin = plane.begin(); begin != plane.end();) {
      const auto end =
          std::find_if(begin, plane.end(), [&](const FacePatch& p) { return p.row != begin->row; });
      for (int row = 0; row < 8; ++row) {
        runs_.clear();
        for (auto patch = begin; patch != end; ++patch) add_runs(*patch, row);
        close_row(begin->row + row);
      }
      begin = end;
    }
    done_.insert(done_.end(), open_.begin(), open_.end());
  }

  std::vector<Rectangle> take() { return std::move(done_); }

 private:
  void add_runs(const FacePatch& patch, int row) {
    unsigned faces = unsigned(patch.faces >> (8 * row)) & 0xff;
    for (int column = patch.column; faces != 0;) {
      const int gap = std::countr_zero(faces), length = std::countr_one(faces >> gap);
      const int begin = column + gap, end = begin + length;
      if (!runs_.empty() && runs_.back().end == begin) {
        runs_.back().end = end;
      } else {
        runs_.push_back({patch.row + row, patch.row + row + 1, begin, end});
      }
      faces >>= gap + length;
      column = end;
    }
  }

  /// Rectangles that end with the row before go on in a run of the same extent, or are done. Both
  /// lists are sorted by their first column.
  void close_row(int row) {
    auto run = runs_.begin();
    for (const Rectangle& above : open_) {
      while (run != runs_.end() && run->begin < above.begin) ++run;
      const bool goes_on = above.bottom == row && run != runs_.end() && run->begin == above.begin &&
                           run->end == above.end;
      goes_on ? void(run->top = above.top) : done_.push_back(above);
    }
    open_.swap(runs_);
  }

  std::vector<Rectangle> done_, open_, runs_;  // open_: those that end with the row before
};

struct PlaneRectangles {
  AxisPlane plane;
  std::vector<Rectangle> rectangles;
};

std::vector<PlaneRectangles> merged(const std::vector<FacePatch>& patches) {
  std::vector<std::span<const FacePatch>> planes;
  for (auto begin = patches.begin(); begin != patches.end();) {
    const auto end = std::find_if(begin, patches.end(),
                                  [&](const FacePatch& p) { return p.plane != begin->plane; });
    planes.emplace_back(begin, end);
    begin = end;
  }
  std::vector<PlaneRectangles> result(planes.size());
  tbb::parallel_for(std::size_t(0), planes.size(), [&](std::size_t i) {
    result[i] = {planes[i].front().plane, Merger(planes[i]).take()};
  });
  return result;
}

/// Corners of the grid's voxels, and of those next to it, as single numbers.
class CornerNumbers {
 public:
  explicit CornerNumbers(const GridGeometry& geometry)
      : ny_(std::uint64_t(geometry.size().y()) + 3), nz_(std::uint64_t(geometry.size().z()) + 3) {}

  std::uint64_t number(const AxisPlane& plane, int row, int column) const {
    Eigen::Vector3i corner;
    corner[plane.axis] = plane.position;
    corner[(plane.axis + 1) % 3] = row;
    corner[(plane.axis + 2) % 3] = column;
    return (std::uint64_t(corner.x() + 1) * ny_ + std::uint64_t(corner.y() + 1)) * nz_ +
           std::uint64_t(corner.z() + 1);
  }
  Eigen::Vector3i corner(std::uint64_t number) const {
    return {int(number / nz_ / ny_) - 1, int(number / nz_ % ny_) - 1, int(number % nz_) - 1};
  }

 private:
  std::uint64_t ny_, nz_;
};

/// The corners of all rectangles, four each: as (top, begin), (bottom, begin), (bottom, end),
/// (top, end) where the faces look up their axis, the other way round where they look down.
std::vector<std::uint64_t> rectangle_corners(const std::vector<PlaneRectangles>& planes,
                                             const CornerNumbers& numbers) {
  std::vector<std::uint64_t> corners;
  for (const auto& [plane, rectangles] : planes) {
    for (const Rectangle& r : rectangles) {
      corners.push_back(numbers.number(plane, r.top, r.begin));
      corners.push_back(numbers.number(plane, r.bottom, r.begin));
      corners.push_back(numbers.number(plane, r.bottom, r.end));
      corners.push_back(numbers.number(plane, r.top, r.end));
      if (plane.sign < 0) std::swap(*std::prev(corners.end()), *std::prev(corners.end(), 3));
    }
  }
  return corners;
}

TriangleMesh mesh_of(const std::vector<FacePatch>& patches, const GridGeometry& geometry) {
  const CornerNumbers numbers(geometry);
  const std::vector<std::uint64_t> corners = rectangle_corners(merged(patches), numbers);
  std::vector<std::uint64_t> used = corners;
  tbb::parallel_sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());

  std::vector<Eigen::Vector3f> vertices(used.size());
  for (std::size_t i = 0; i < used.size(); ++i) {
    vertices[i] = geometry.corner(numbers.corner(used[i])).cast<float>();
  }
  std::vector<Triangle> triangles(corners.size() / 2);
  tbb::parallel_for(std::size_t(0), corners.size() / 4, [&](std::size_t r) {
    std::array<std::uint32_t, 4> v;
    for (std::size_t c = 0; c < 4; ++c) {
      const auto entry = std::lower_bound(used.begin(), used.end(), corners[4 * r + c]);
      v[c] = std::uint32_t(entry - used.begin());
    }
    triangles[2 * r] = {v[0], v[1], v[2]};
    triangles[2 * r + 1] = {v[0], v[2], v[3]};
  });
  return {std::move(vertices), std::move(triangles), "voxel faces"};
}

}  // namespace

TriangleMesh voxel_faces(const openvdb::MaskTree& voxels, const GridGeometry& geometry) {
  return mesh_of(face_patches(voxels), geometry);
}

ShadowSurface split_voxel_faces(const openvdb::MaskTree& voxels, const openvdb::MaskTree& covering,
                                const GridGeometry& geometry) {
  const SplitPatches parts = split(face_patches(voxels), covering);
  return {mesh_of(parts.open, geometry), mesh_of(parts.covered, geometry)};
}

}  // namespace volume::detail

TriangleMesh voxel_faces(const StateGrid& grid, VoxelState state) {
  return volume::detail::with_voxels(grid.impl(), state, [&](const openvdb::MaskTree& voxels) {
    return volume::detail::voxel_faces(voxels, grid.geometry());
  });
}

TriangleMesh measured_faces(const StateGrid& grid) {
  return volume::detail::voxel_faces(grid.impl().measured, grid.geometry());
}

ShadowSurface shadow_surface(const StateGrid& grid, OccluderMode mode) {
  const volume::detail::StateGridImpl& impl = grid.impl();
  const openvdb::MaskTree& solid = mode == OccluderMode::voxels ? impl.occupied : impl.measured;
  return volume::detail::split_voxel_faces(impl.shadow, solid, grid.geometry());
}

}  // namespace vantage
