#include "carve/lattice_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage::volume::detail {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A depth lattice's own depth range plays no part.
constexpr DepthRange kAnyDepth = {1e-9, 1e30};

/// Over more cells than these, their planes cost more than they save.
constexpr int kMaxPlaneCells = 25;

/// The lattice's camera with the axes' units as pixels, so that the lattice just fits the image.
PinholeCamera camera_of_units(const PinholeCamera& camera, const Pose& T_grid_world,
                              const LatticeAxis& columns, const LatticeAxis& rows) {
  Intrinsics k = camera.intrinsics();
  k.width = int(columns.length) + 2, k.height = int(rows.length) + 2;
  k.cx = (k.cx - columns.first) * columns.per_pixel;
  k.cy = (k.cy - rows.first) * rows.per_pixel;
  k.fx *= columns.per_pixel, k.fy *= rows.per_pixel;
  return {k, T_grid_world * camera.T_world_cam(), kAnyDepth};
}

Eigen::Matrix3d image_matrix(const PinholeCamera& camera) {
  const Intrinsics& k = camera.intrinsics();
  Eigen::Matrix3d K;
  K << k.fx, 0, k.cx, 0, k.fy, k.cy, 0, 0, 1;
  return K * camera.T_world_cam().rotation().transpose();
}

}  // namespace

/// A box as (u z, v z, z): its centre and its half axes.
struct LatticeView::BoxOnImage {
  Eigen::Vector3d centre;
  Eigen::Matrix3d half_axes;

  /// How far in front of a surface that is a plane in inverse depth, its depth apart: `plane` times
  /// (u z, v z, z) is 1 on it. Smallest and largest value over the box.
  double smallest_front(const Eigen::Vector3d& plane) const {
    return 1 - plane.dot(centre) - reach(plane);
  }
  double largest_front(const Eigen::Vector3d& plane) const {
    return 1 - plane.dot(centre) + reach(plane);
  }
  double reach(const Eigen::Vector3d& plane) const {
    return (plane.transpose() * half_axes).cwiseAbs().sum();
  }
};

LatticeView::LatticeView(const VisibilityMesh& lattice, const Pose& T_grid_world,
                         const GridFrame& frame)
    : frame_(frame),
      columns_(lattice.columns),
      rows_(lattice.rows),
      inverse_(lattice.depth.size()),
      camera_(camera_of_units(lattice.camera, T_grid_world, columns_, rows_)),
      projector_(camera_),
      image_grid_(image_matrix(camera_)) {
  std::transform(lattice.depth.begin(), lattice.depth.end(), inverse_.begin(),
                 [](float depth) { return 1 / double(depth); });
  build_pyramids(lattice);
}

void LatticeView::build_pyramids(const VisibilityMesh& lattice) {
  const std::size_t width = lattice.width(), cells_x = width - 1, cells_y = lattice.height() - 1;
  std::vector<float> nearest(cells_x * cells_y), farthest(nearest.size());
  for (std::size_t j = 0; j < cells_y; ++j) {
    const float* const upper = &lattice.depth[j * width];
    const float* const lower = upper + width;
    for (std::size_t i = 0; i < cells_x; ++i) {
      const float sum = upper[i] + upper[i + 1] + lower[i] + lower[i + 1];
      const bool there = !std::isnan(sum);  // it may overflow, but depths have no infinities
      const float low =
          std::min(std::min(upper[i], upper[i + 1]), std::min(lower[i], lower[i + 1]));
      const float high =
          std::max(std::max(upper[i], upper[i + 1]), std::max(lower[i], lower[i + 1]));
      nearest[j * cells_x + i] = there ? low : -kInfinity;
      farthest[j * cells_x + i] = there ? -high : kInfinity;
    }
  }
  nearest_ = MinPyramid(int(cells_x), int(cells_y), std::move(nearest));
  negative_farthest_ = MinPyramid(int(cells_x), int(cells_y), std::move(farthest));
}

RangeSeen LatticeView::ask(const CellRange& blocks) const {
  const Extent extent = frame_.extent_of_centres(frame_.layout.voxels_in(blocks));
  const double margin_m = projector_.margin_m(extent);
  const BoxInView box = projector_.project(extent, margin_m);
  const ImageRect& rect = box.rect;
  if (box.coverage == Coverage::none || rect.u1 < 0 || rect.u0 > columns_.length || rect.v1 < 0 ||
      rect.v0 > rows_.length) {
    return {false, false};
  }
  RangeSeen answer;
  if (rect.u0 >= 0 && rect.u1 <= columns_.length && rect.v0 >= 0 && rect.v1 <= rows_.length) {
    answer.covered = true;
  }
  const LatticeCells c = cells_under(rect);
  if (box.z_min > -double(negative_farthest_.min_over(c.i0, c.i1, c.j0, c.j1))) {
    answer.seen = false;
  } else if (box.z_max < double(nearest_.min_over(c.i0, c.i1, c.j0, c.j1))) {
    answer.seen = true;
  } else if (box.z_min > 0 && c.count() <= kMaxPlaneCells) {
    answer.seen = ask_planes(c, extent, margin_m);
  }
  // What is beyond the rectangle is not seen, wherever the surface is.
  if (!answer.covered && answer.seen == true) answer.seen.reset();
  return answer;
}

LatticeCells LatticeView::cells_under(const ImageRect& rect) const {
  return {columns_.cell(rect.u0), columns_.cell(rect.u1), rows_.cell(rect.v0), rows_.cell(rect.v1)};
}

/// Planes in inverse depth are planes in space: the box is in front of the surface if it is in
/// front of the planes of all cells that it may fall on.
std::optional<bool> LatticeView::ask_planes(const LatticeCells& cells, const Extent& box,
                                            double margin_m) const {
  const Eigen::Vector3d half = box.half.array() + margin_m;
  const BoxOnImage on_image{image_grid_ * (box.centre - camera_.centre()),
                            image_grid_ * half.asDiagonal()};
  bool before = true, behind = true;
  for (int j = cells.j0; j <= cells.j1; ++j) {
    for (int i = cells.i0; i <= cells.i1; ++i) {
      Eigen::Vector3d planes[2];
      if (!planes_of_cell(i, j, planes)) {
        before = false;
        continue;
      }
      for (const Eigen::Vector3d& plane : planes) {
        before = before && on_image.smallest_front(plane) > 0;
        behind = behind && on_image.largest_front(plane) < 0;
      }
    }
    if (!before && !behind) return std::nullopt;
  }
  return before;
}

/// The inverse depth of a cell's two triangles, by (u, v, 1). Nothing for a cell that is not there.
bool LatticeView::planes_of_cell(int i, int j, Eigen::Vector3d (&planes)[2]) const {
  const std::size_t column = std::size_t(i), row = std::size_t(j);
  const double* const upper = &inverse_[row * columns_.vertices.size() + column];
  const double* const lower = upper + columns_.vertices.size();
  if (std::isnan(upper[0] + upper[1] + lower[0] + lower[1])) return false;
  const auto plane = [&](double corner, double u, double v, double du, double dv) {
    return Eigen::Vector3d(du, dv, corner - u * du - v * dv);
  };
  const double per_u = columns_.per_cell[column], per_v = rows_.per_cell[row];
  planes[0] = plane(upper[0], columns_.vertices[column], rows_.vertices[row],
                    (upper[1] - upper[0]) * per_u, (lower[0] - upper[0]) * per_v);
  planes[1] = plane(lower[1], columns_.vertices[column + 1], rows_.vertices[row + 1],
                    (lower[1] - lower[0]) * per_u, (lower[1] - upper[1]) * per_v);
  return true;
}

BlockSeen LatticeView::compare(const Eigen::Vector3i& block) const {
  const double size = frame_.voxel_size_m;
  const Extent extent =
      frame_.extent_of_centres({kBlockSide * block, kBlockSide * (block.array() + 1)});
  const LatticeCells cells =
      cells_under(projector_.project(extent, projector_.margin_m(extent)).rect);
  BlockSeen result;
  for (int x = 0; x < kBlockSide; ++x) {
    const Eigen::Vector3d voxel = (kBlockSide * block + Eigen::Vector3i(x, 0, 0)).cast<double>();
    const Eigen::Vector3d first = size * (voxel + Eigen::Vector3d::Constant(0.5));
    const LayerSeen layer = compare_layer(columns_, rows_, cells, inverse_.data(),
                                          {image_grid_ * (first - camera_.centre()),
                                           size * image_grid_.col(1), size * image_grid_.col(2)});
    result.covered.words[std::size_t(x)] = layer.covered;
    result.seen.words[std::size_t(x)] = layer.seen;
  }
  return result;
}

namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

}  // namespace

bool LatticeView::has_cell(int i, int j) const {
  if (i < 0 || j < 0 || i >= columns_.cells() || j >= rows_.cells()) return false;
  const std::size_t width = columns_.vertices.size();
  const double* const upper = &inverse_[std::size_t(j) * width + std::size_t(i)];
  return !std::isnan(upper[0] + upper[1] + upper[width] + upper[width + 1]);
}

/// To the nearest side of a cell that has a cell on one side only: the walls between what cameras
/// see, and holes and what is beyond the rectangle. Pixels may lie outside of the cell.
double LatticeView::distance_to_sides_m(const Eigen::Array2d& pixel,
                                        const Eigen::Array2d& metres_per_pixel, int i,
                                        int j) const {
  const bool here = has_cell(i, j);
  const std::size_t column = std::size_t(i), row = std::size_t(j);
  const Eigen::Array2d to_low =
      (pixel - Eigen::Array2d(columns_.vertices[column], rows_.vertices[row])) * metres_per_pixel;
  const Eigen::Array2d to_high =
      (Eigen::Array2d(columns_.vertices[column + 1], rows_.vertices[row + 1]) - pixel) *
      metres_per_pixel;
  double nearest = kFar;
  if (has_cell(i - 1, j) != here) nearest = std::min(nearest, to_low.x());
  if (has_cell(i + 1, j) != here) nearest = std::min(nearest, to_high.x());
  if (has_cell(i, j - 1) != here) nearest = std::min(nearest, to_low.y());
  if (has_cell(i, j + 1) != here) nearest = std::min(nearest, to_high.y());
  return nearest;
}

double LatticeView::depth_in_seen_m(const Eigen::Vector3d& p_grid) const {
  const Eigen::Vector3d on_image = image_grid_ * (p_grid - camera_.centre());
  const double depth = on_image.z();
  if (!(depth > 0)) return -kFar;
  const Eigen::Array2d pixel = on_image.head<2>().array() / depth;
  const Intrinsics& k = camera_.intrinsics();
  const int i = columns_.cell(pixel.x()), j = rows_.cell(pixel.y());
  const double sides = distance_to_sides_m(pixel, {depth / k.fx, depth / k.fy}, i, j);
  Eigen::Vector3d planes[2];
  if (!planes_of_cell(i, j, planes)) return -sides;
  const double x =
      (pixel.x() - columns_.vertices[std::size_t(i)]) * columns_.per_cell[std::size_t(i)];
  const double y = (pixel.y() - rows_.vertices[std::size_t(j)]) * rows_.per_cell[std::size_t(j)];
  const Eigen::Vector3d& plane = planes[x + y <= 1 ? 0 : 1];
  const double gradient = (image_grid_.transpose() * plane).norm();
  return std::min((1 - plane.dot(on_image)) / gradient, sides);
}

}  // namespace vantage::volume::detail
