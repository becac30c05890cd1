#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/export.hpp"

namespace vantage {

/// What a camera saw through, as a volume: the pyramids from its centre to the cells of a lattice
/// of pixels with depths (the visibility mesh of thesis 7.4.2). Along a pixel's ray everything up
/// to the lattice's surface is free, everything behind it is not.
///
/// Vertex (i, j) is at pixel (columns[i], rows[j]) and `depth[j · columns.size() + i]`. A cell
/// between four vertices is there if all four depths are known; it is two triangles, and their
/// common edge runs from (i + 1, j) to (i, j + 1). In pixels and inverse depth a triangle is a
/// plane.
struct VisibilityMesh {
  PinholeCamera camera;        ///< its depth range plays no part
  std::vector<float> columns;  ///< pixel coordinates, strictly increasing, 2 to 32,767 of them
  std::vector<float> rows;     ///< the same
  std::vector<float> depth;    ///< metres along the optical axis; NaN where it is unknown

  std::size_t width() const noexcept { return columns.size(); }
  std::size_t height() const noexcept { return rows.size(); }

  /// @throws Error bad_input unless the sizes fit, the coordinates increase and are within a
  /// million pixels, and every depth is positive and finite, or NaN; `where` names the place.
  VANTAGE_API void check(std::string_view where = "depth lattice") const;

  /// Whether cell (i, j), with i < width() - 1 and j < height() - 1, is there.
  VANTAGE_API bool has_cell(std::size_t i, std::size_t j) const;

  /// Whether a point is inside the volume: of its pixel's inverse depth on the surface, its own is
  /// the larger one. In double; a point on the surface or on a border may count as either.
  VANTAGE_API bool sees(const Eigen::Vector3d& p_world) const;
};

}  // namespace vantage
