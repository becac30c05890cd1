#include "mesh/mesh_builder.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "geometry/coordinates.hpp"

namespace vantage::raycore::detail {

void MeshCollector::reserve(std::size_t vertices, std::size_t triangles) {
  vertices_.reserve(vertices);
  triangles_.reserve(triangles);
}

void MeshCollector::add_vertex(const Eigen::Vector3d& p_file, const FilePlace& place) {
  const Eigen::Vector3d p = unit_m_ * p_file;
  if (!p_file.allFinite()) {
    place.fail(fmt::format("the vertex is {}; expected finite coordinates", to_text(p_file)));
  }
  // Rounding to float may step onto the limit, which the mesh no longer takes.
  const Eigen::Vector3f rounded = p.cast<float>();
  if (!is_coordinate(rounded)) {
    place.fail(
        fmt::format("the vertex is {} with a unit of {} m; expected coordinates below "
                    "{:g} m (is the unit right?)",
                    to_text(p_file), unit_m_, kMaxCoordinate));
  }
  if (vertices_.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::out_of_resources, place.text(),
                "a mesh holds at most 4294967295 vertices");
  }
  vertices_.push_back(rounded);
}

void MeshCollector::add_polygon(std::span<const std::int64_t> corners, std::uint64_t vertex_count,
                                const FilePlace& place) {
  if (corners.size() < 3) {
    place.fail(fmt::format("the face has {} corners; expected 3 or more", corners.size()));
  }
  for (const std::int64_t index : corners) {
    if (index >= 0 && std::uint64_t(index) < vertex_count) continue;
    place.fail(
        fmt::format("the face has a corner at vertex {}; expected 0 or more and less than "
                    "{}, the number of vertices",
                    index, vertex_count));
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles_.push_back(
        {std::uint32_t(corners[0]), std::uint32_t(corners[i - 1]), std::uint32_t(corners[i])});
  }
}

void MeshCollector::add_triangle_of_last_vertices() {
  const auto end = std::uint32_t(vertices_.size());
  triangles_.push_back({end - 3, end - 2, end - 1});
}

TriangleMesh MeshCollector::finish() && {
  const std::size_t found = triangles_.size();
  TriangleMesh mesh(std::move(vertices_), std::move(triangles_), file_);
  if (!mesh.empty()) return mesh;
  throw bad_input(file_, found == 0 ? "has no triangles; expected at least one"
                                    : fmt::format("has {} triangles, none of them with an area; "
                                                  "expected at least one",
                                                  found));
}

}  // namespace vantage::raycore::detail
