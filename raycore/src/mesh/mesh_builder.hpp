#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/file_place.hpp"
#include "vantage/raycore/mesh_io.hpp"

namespace vantage::raycore::detail {

/// Builds a mesh from what the readers of mesh files find: checks each vertex and index while the
/// place in the file is still known, turns units into metres and the file's up axis to z, and cuts
/// polygons into triangles.
class MeshBuilder {
 public:
  MeshBuilder(std::string file, const MeshFileFrame& frame)
      : file_(std::move(file)), frame_(frame) {
    set_file_up(UpAxis::z);
  }
  MeshBuilder(std::string file, double unit_m)
      : MeshBuilder(std::move(file), MeshFileFrame{unit_m, {}}) {}

  const std::string& file() const { return file_; }
  std::size_t vertex_count() const { return vertices_.size(); }
  std::size_t triangle_count() const { return triangles_.size(); }
  void reserve(std::size_t vertices, std::size_t triangles);

  /// The up axis that the file or its format states; the user's choice overrides it. For the
  /// vertices that follow.
  void set_file_up(UpAxis up);

  /// Coordinates in the file's unit; they are scaled before they are rounded to float. One that is
  /// not finite or too far out is an error only if a face uses it: `finish` says so.
  /// @param place its `unit` is a string literal.
  void add_vertex(const Eigen::Vector3d& p_file, const FilePlace& place);

  /// Fewer than three corners do not make a face: they are counted, and remarked in the end.
  /// @throws Error bad_input for an index outside 0 … `vertex_count` - 1; the file's vertices may
  /// follow its faces.
  void add_polygon(std::span<const std::int64_t> corners, std::uint64_t vertex_count,
                   const FilePlace& place);

  /// The last three vertices as one triangle.
  void add_triangle_of_last_vertices();

  /// A remark on something odd but harmless; without the file's name.
  void add_remark(std::string remark);

  /// @throws Error bad_input if there is no triangle with an area, a face uses a vertex that is not
  /// finite or too far out, or a polygon is too complex.
  TriangleMesh finish() &&;

 private:
  /// A vertex with a coordinate that is not finite or too large.
  struct BadVertex {
    std::uint32_t index;
    Eigen::Vector3d p_file;
    FilePlace place;
  };

  [[noreturn]] void fail_at(const BadVertex& bad) const;
  void triangulate_waiting();
  void remove_bad_vertices();

  std::string file_;
  MeshFileFrame frame_;
  Eigen::Matrix3d T_mesh_file_;
  std::vector<Eigen::Vector3f> vertices_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> waiting_;      // polygons until all vertices are there: count, corners
  std::uint64_t tests_left_ = 100'000'000;  // of `triangulate`
  std::vector<BadVertex> bad_vertices_;
  std::size_t small_faces_ = 0;
  std::vector<std::string> remarks_;
};

}  // namespace vantage::raycore::detail
