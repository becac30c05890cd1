#include "voxel_faces.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include "state_grid_impl.hpp"

namespace vantage::detail {
namespace {

/// A unit face in its plane.
struct Cell {
  int row, column;
  auto operator<=>(const Cell&) const = default;
};

/// columns [begin, end) of rows [top, bottom).
struct Rectangle {
  int top, bottom, begin, end;
};

/// Which way a face looks, and in which plane it lies (index coordinate along `axis`).
struct Plane {
  int axis, sign, position;
  auto operator<=>(const Plane&) const = default;
};

using FacesByPlane = std::map<Plane, std::vector<Cell>>;

FacesByPlane collect(const openvdb::MaskTree& voxels) {
  FacesByPlane faces;
  openvdb::tree::ValueAccessor<const openvdb::MaskTree> at(voxels);
  for (auto leaf = voxels.cbeginLeaf(); leaf; ++leaf) {
    for (auto value = leaf->cbeginValueOn(); value; ++value) {
      const openvdb::Coord c = value.getCoord();
      for (int axis = 0; axis < 3; ++axis) {
        for (const int sign : {-1, 1}) {
          openvdb::Coord neighbour = c;
          neighbour[axis] += sign;
          if (at.isValueOn(neighbour)) continue;
          faces[{axis, sign, c[axis] + (sign > 0)}].push_back(
              {c[(axis + 1) % 3], c[(axis + 2) % 3]});
        }
      }
    }
  }
  return faces;
}

std::vector<Rectangle> merge(std::vector<Cell>& cells) {
  std::sort(cells.begin(), cells.end());
  std::vector<Rectangle> done, open;  // open: rectangles that end with the row before
  for (std::size_t i = 0; i < cells.size();) {
    const int row = cells[i].row;
    std::vector<Rectangle> runs;
    for (; i < cells.size() && cells[i].row == row; ++i) {
      if (!runs.empty() && runs.back().end == cells[i].column) {
        ++runs.back().end;
      } else {
        runs.push_back({row, row + 1, cells[i].column, cells[i].column + 1});
      }
    }
    for (const Rectangle& above : open) {  // both lists are sorted by their first column
      const auto below = std::find_if(runs.begin(), runs.end(), [&](const Rectangle& run) {
        return above.bottom == row && run.begin == above.begin && run.end == above.end;
      });
      below == runs.end() ? done.push_back(above) : void(below->top = above.top);
    }
    open = std::move(runs);
  }
  done.insert(done.end(), open.begin(), open.end());
  return done;
}

class MeshOfRectangles {
 public:
  explicit MeshOfRectangles(const GridGeometry& geometry) : geometry_(geometry) {}

  void add(const Plane& plane, const Rectangle& r) {
    const std::uint32_t a = vertex(plane, r.top, r.begin), b = vertex(plane, r.bottom, r.begin);
    const std::uint32_t c = vertex(plane, r.bottom, r.end), d = vertex(plane, r.top, r.end);
    if (plane.sign > 0) {
      triangles_.push_back({a, b, c}), triangles_.push_back({a, c, d});
    } else {
      triangles_.push_back({a, c, b}), triangles_.push_back({a, d, c});
    }
  }
  TriangleMesh finish() { return {std::move(vertices_), std::move(triangles_), "voxel faces"}; }

 private:
  std::uint32_t vertex(const Plane& plane, int row, int column) {
    Eigen::Vector3i index;
    index[plane.axis] = plane.position;
    index[(plane.axis + 1) % 3] = row;
    index[(plane.axis + 2) % 3] = column;
    const auto [entry, is_new] = ids_.try_emplace(std::tuple{index.x(), index.y(), index.z()},
                                                  std::uint32_t(vertices_.size()));
    if (is_new) vertices_.push_back(geometry_.corner(index).cast<float>());
    return entry->second;
  }

  const GridGeometry& geometry_;
  std::map<std::tuple<int, int, int>, std::uint32_t> ids_;
  std::vector<Eigen::Vector3f> vertices_;
  std::vector<Triangle> triangles_;
};

}  // namespace

TriangleMesh voxel_faces(const openvdb::MaskTree& voxels, const GridGeometry& geometry) {
  MeshOfRectangles mesh(geometry);
  for (auto& [plane, cells] : collect(voxels)) {
    for (const Rectangle& rectangle : merge(cells)) mesh.add(plane, rectangle);
  }
  return mesh.finish();
}

}  // namespace vantage::detail
