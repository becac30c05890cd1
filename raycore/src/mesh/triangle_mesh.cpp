#include "vantage/raycore/triangle_mesh.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <utility>

#include "geometry/coordinates.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

void check_vertices(const std::vector<Eigen::Vector3f>& vertices, std::string_view where) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (raycore::detail::is_coordinate(vertices[i])) continue;
    throw bad_input(
        fmt::format("{}, vertex {}", where, i),
        fmt::format("lies at {} m; expected finite coordinates below {:g} m (is the unit right?)",
                    raycore::detail::to_text(vertices[i]), raycore::detail::kMaxCoordinate));
  }
}

void check_indices(const std::vector<Triangle>& triangles, std::size_t vertex_count,
                   std::string_view where) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (const std::uint32_t index : triangles[i]) {
      if (index < vertex_count) continue;
      throw bad_input(fmt::format("{}, triangle {}", where, i),
                      fmt::format("has a corner at vertex {}; expected an index below {}, the "
                                  "number of vertices",
                                  index, vertex_count));
    }
  }
}

/// The area is computed in double, where the products of two floats are exact.
bool is_degenerate(const std::vector<Eigen::Vector3f>& vertices, const Triangle& triangle) {
  const Eigen::Vector3d a = vertices[triangle[0]].cast<double>();
  const Eigen::Vector3d ab = vertices[triangle[1]].cast<double>() - a;
  const Eigen::Vector3d ac = vertices[triangle[2]].cast<double>() - a;
  return ab.cross(ac) == Eigen::Vector3d::Zero();
}

}  // namespace

TriangleMesh::TriangleMesh(std::vector<Eigen::Vector3f> vertices, std::vector<Triangle> triangles,
                           std::string_view where)
    : vertices_(std::move(vertices)), triangles_(std::move(triangles)) {
  check_vertices(vertices_, where);
  check_indices(triangles_, vertices_.size(), where);
  dropped_degenerate_ = std::erase_if(
      triangles_, [this](const Triangle& triangle) { return is_degenerate(vertices_, triangle); });
}

TriangleMesh TriangleMesh::from_box(const Box& box) {
  return from_boxes({&box, 1});
}

TriangleMesh TriangleMesh::from_boxes(std::span<const Box> boxes) {
  // Bit 0 of a vertex's index chooses x, bit 1 chooses y, bit 2 chooses z.
  constexpr Triangle kFaces[] = {
      {0, 2, 3}, {0, 3, 1},  // below
      {4, 5, 7}, {4, 7, 6},  // above
      {0, 1, 5}, {0, 5, 4},  // y min
      {2, 6, 7}, {2, 7, 3},  // y max
      {0, 4, 6}, {0, 6, 2},  // x min
      {1, 3, 7}, {1, 7, 5},  // x max
  };
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Triangle> triangles;
  vertices.reserve(8 * boxes.size());
  triangles.reserve(12 * boxes.size());
  for (const Box& box : boxes) {
    const std::uint32_t first = std::uint32_t(vertices.size());
    for (int i = 0; i < 8; ++i) {
      vertices.push_back(Eigen::Vector3d((i & 1) != 0 ? box.max().x() : box.min().x(),
                                         (i & 2) != 0 ? box.max().y() : box.min().y(),
                                         (i & 4) != 0 ? box.max().z() : box.min().z())
                             .cast<float>());
    }
    for (const Triangle& f : kFaces)
      triangles.push_back({first + f[0], first + f[1], first + f[2]});
  }
  return {std::move(vertices), std::move(triangles), "box"};
}

TriangleMesh TriangleMesh::transformed(const Pose& T_target_mesh) const {
  std::vector<Eigen::Vector3f> moved;
  moved.reserve(vertices_.size());
  for (const Eigen::Vector3f& p_mesh : vertices_) {
    moved.push_back((T_target_mesh * p_mesh.cast<double>()).cast<float>());
  }
  TriangleMesh result(std::move(moved), triangles_, "transformed mesh");
  result.dropped_degenerate_ += dropped_degenerate_;
  result.remarks_ = remarks_;
  return result;
}

TriangleMesh TriangleMesh::scaled(double factor) const {
  if (!std::isfinite(factor) || factor <= 0) {
    throw bad_input("factor", fmt::format("is {}; expected a finite scale factor above 0", factor));
  }
  std::vector<Eigen::Vector3f> resized;
  resized.reserve(vertices_.size());
  for (const Eigen::Vector3f& p : vertices_) {
    resized.push_back((factor * p.cast<double>()).cast<float>());
  }
  TriangleMesh result(std::move(resized), triangles_, "scaled mesh");
  result.dropped_degenerate_ += dropped_degenerate_;
  result.remarks_ = remarks_;
  return result;
}

TriangleMesh TriangleMesh::with_remarks(std::vector<std::string> remarks) const {
  TriangleMesh result = *this;
  result.remarks_ = remarks.empty()
                        ? nullptr
                        : std::make_shared<const std::vector<std::string>>(std::move(remarks));
  return result;
}

}  // namespace vantage
