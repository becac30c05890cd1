#include <algorithm>
#include <cmath>
#include <limits>

#include "carve/lattice_view.hpp"

namespace vantage::detail {
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

}  // namespace vantage::detail
