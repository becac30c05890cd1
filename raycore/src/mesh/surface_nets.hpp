#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::raycore::detail {

/// Below 0 inside.
using Field = std::function<double(const Eigen::Vector3d&)>;

/// Corners (i, j, k) at `origin + cell * (i, j, k)`, 0 <= i < corners[0] and so on.
struct SamplingGrid {
  Eigen::Vector3d origin;
  double cell = 0;
  std::array<int, 3> corners = {};

  Eigen::Vector3d corner(int i, int j, int k) const {
    return origin + cell * Eigen::Vector3d(i, j, k);
  }
};

/// A closed surface of quadrilaterals, counter-clockwise seen from outside.
struct QuadMesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::uint32_t, 4>> quads;
};

/// Where the field is 0: a vertex in every cell that it runs through, in the mean of its crossings
/// with the cell's edges. After S. Gibson, "Constrained elastic surface nets", 1998, without the
/// relaxation. Closed and manifold for fields without details as small as a cell that are above 0
/// all over the grid's outside.
QuadMesh surface_nets(const Field& field, const SamplingGrid& grid);

/// Cuts each quadrilateral along its shorter diagonal.
std::vector<Triangle> cut_in_two(const QuadMesh& mesh);

}  // namespace vantage::raycore::detail
