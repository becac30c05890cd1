#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/file_place.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::raycore::detail {

/// Where the readers of mesh files put what they find: it checks each vertex and index where the
/// place in the file is still known, turns units into metres, and splits polygons.
class MeshCollector {
 public:
  MeshCollector(std::string file, double unit_m) : file_(std::move(file)), unit_m_(unit_m) {}

  const std::string& file() const { return file_; }
  std::size_t vertex_count() const { return vertices_.size(); }
  void reserve(std::size_t vertices, std::size_t triangles);

  /// Coordinates in the file's unit; they are scaled before they are rounded to float.
  /// @throws Error bad_input if one is not finite or too far out.
  void add_vertex(const Eigen::Vector3d& p_file, const FilePlace& place);

  /// A fan around the polygon's first corner.
  /// @throws Error bad_input if there are fewer than three corners, or for an index outside
  /// 0 … `vertex_count` - 1; the file's vertices may follow its faces.
  void add_polygon(std::span<const std::int64_t> corners, std::uint64_t vertex_count,
                   const FilePlace& place);

  /// The last three vertices as one triangle.
  void add_triangle_of_last_vertices();

  /// @throws Error bad_input if there is no triangle with an area.
  TriangleMesh finish() &&;

 private:
  std::string file_;
  double unit_m_;
  std::vector<Eigen::Vector3f> vertices_;
  std::vector<Triangle> triangles_;
};

}  // namespace vantage::raycore::detail
