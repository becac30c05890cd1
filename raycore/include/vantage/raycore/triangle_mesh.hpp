#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/raycore/box.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

using Triangle = std::array<std::uint32_t, 3>;

/// Triangles with counter-clockwise corners seen from outside, metres. Immutable value type.
///
/// Always valid: vertices are finite and below 1e6 m, indices are in range, no face is degenerate.
class VANTAGE_API TriangleMesh {
 public:
  /// No triangles.
  TriangleMesh() = default;

  /// Faces without area (equal or collinear corners) are dropped and counted.
  /// @throws Error bad_input if a vertex is not finite or too far out, or an index out of range.
  TriangleMesh(std::vector<Eigen::Vector3f> vertices, std::vector<Triangle> triangles,
               std::string_view where = "mesh");

  /// The twelve triangles of a box; faces look outwards.
  static TriangleMesh from_box(const Box& box);

  /// The same for N boxes in one mesh, twelve triangles each, in their order.
  static TriangleMesh from_boxes(std::span<const Box> boxes);

  const std::vector<Eigen::Vector3f>& vertices() const noexcept { return vertices_; }
  const std::vector<Triangle>& triangles() const noexcept { return triangles_; }
  std::size_t dropped_degenerate() const noexcept { return dropped_degenerate_; }
  bool empty() const noexcept { return triangles_.empty(); }

  /// Oddities of the file that the mesh comes from; each is a sentence without a full stop that
  /// begins with the place in the file. Moved and scaled copies keep them.
  std::span<const std::string> remarks() const noexcept {
    return remarks_ == nullptr ? std::span<const std::string>() : *remarks_;
  }

  /// The same mesh with remarks in place of those that it had.
  TriangleMesh with_remarks(std::vector<std::string> remarks) const;

  /// Corner `corner` (0, 1, 2) of triangle `triangle`.
  const Eigen::Vector3f& corner(std::size_t triangle, int corner) const {
    return vertices_[triangles_[triangle][std::size_t(corner)]];
  }

  /// Computed in double. The count of dropped faces goes on, here and in `scaled`.
  /// @throws Error bad_input if a vertex comes to lie too far out.
  TriangleMesh transformed(const Pose& T_target_mesh) const;

  /// Every coordinate times `factor`, computed in double.
  /// @throws Error bad_input unless `factor` is positive and finite, or as `transformed` does.
  TriangleMesh scaled(double factor) const;

 private:
  std::vector<Eigen::Vector3f> vertices_;
  std::vector<Triangle> triangles_;
  std::size_t dropped_degenerate_ = 0;
  std::shared_ptr<const std::vector<std::string>> remarks_;  // null: none
};

}  // namespace vantage
