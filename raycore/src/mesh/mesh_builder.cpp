#include "mesh/mesh_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "geometry/coordinates.hpp"
#include "mesh/triangulate.hpp"

namespace vantage::raycore::detail {
namespace {

/// Turns the file's up axis to z. For y it is what COLLADA's and glTF's users expect: x stays, and
/// what looks at the viewer (z) looks along -y; for x it is COLLADA's X_UP. A negative axis is the
/// positive one turned by half about x.
Eigen::Matrix3d turn_up(UpAxis up) {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  if (up == UpAxis::y || up == UpAxis::minus_y) turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  if (up == UpAxis::x || up == UpAxis::minus_x) turn << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  if (up >= UpAxis::minus_x) turn.bottomRows<2>() *= -1;
  return turn;
}

}  // namespace

void MeshBuilder::reserve(std::size_t vertices, std::size_t triangles) {
  vertices_.reserve(vertices);
  triangles_.reserve(triangles);
}

void MeshBuilder::set_file_up(UpAxis up) {
  T_mesh_file_ = turn_up(frame_.up.value_or(up));
}

void MeshBuilder::add_vertex(const Eigen::Vector3d& p_file, const FilePlace& place) {
  if (vertices_.size() >= std::numeric_limits<std::uint32_t>::max()) {
    throw Error(ErrorCode::out_of_resources, place.text(),
                "a mesh holds at most 4294967295 vertices");
  }
  // Rounding to float may step onto the limit, which the mesh no longer takes.
  const Eigen::Vector3f rounded = (T_mesh_file_ * (frame_.unit_m * p_file)).cast<float>();
  if (p_file.allFinite() && is_coordinate(rounded)) {
    vertices_.push_back(rounded);
    return;
  }
  bad_vertices_.push_back({std::uint32_t(vertices_.size()), p_file, place});
  vertices_.push_back(Eigen::Vector3f::Zero());
}

void MeshBuilder::fail_at(const BadVertex& bad) const {
  if (!bad.p_file.allFinite()) {
    bad.place.fail(
        fmt::format("the vertex is {}; expected finite coordinates", to_text(bad.p_file)));
  }
  bad.place.fail(
      fmt::format("the vertex is {} with a unit of {} m; expected coordinates below "
                  "{:g} m (is the unit right?)",
                  to_text(bad.p_file), frame_.unit_m, kMaxCoordinate));
}

void MeshBuilder::add_polygon(std::span<const std::int64_t> corners, std::uint64_t vertex_count,
                              const FilePlace& place) {
  for (const std::int64_t index : corners) {
    if (index >= 0 && std::uint64_t(index) < vertex_count) continue;
    place.fail(
        fmt::format("the face has a corner at vertex {}; expected 0 or more and less than "
                    "{}, the number of vertices",
                    index, vertex_count));
  }
  if (corners.size() < 3) {
    ++small_faces_;
  } else if (corners.size() == 3 && waiting_.empty()) {
    triangles_.push_back(
        {std::uint32_t(corners[0]), std::uint32_t(corners[1]), std::uint32_t(corners[2])});
  } else {
    waiting_.push_back(std::uint32_t(corners.size()));
    for (const std::int64_t index : corners) waiting_.push_back(std::uint32_t(index));
    // Not where the file's faces come before its vertices.
    if (vertex_count == vertices_.size()) triangulate_waiting();
  }
}

void MeshBuilder::triangulate_waiting() {
  std::size_t i = 0;
  while (i < waiting_.size()) {
    const std::span<const std::uint32_t> corners = std::span(waiting_).subspan(i + 1, waiting_[i]);
    // Convex polygons take none; a few hundred for each corner are enough for what people draw.
    tests_left_ += 200 * corners.size();
    if (!triangulate(corners, vertices_, tests_left_, triangles_)) {
      throw bad_input(file_, fmt::format("a polygon of {} corners is too complex to triangulate; "
                                         "triangulate the mesh in the program that made it",
                                         corners.size()));
    }
    i += 1 + corners.size();
  }
  waiting_.clear();
}

void MeshBuilder::add_triangle_of_last_vertices() {
  const auto end = std::uint32_t(vertices_.size());
  triangles_.push_back({end - 3, end - 2, end - 1});
}

void MeshBuilder::add_remark(std::string remark) {
  remarks_.push_back(file_ + ": " + std::move(remark));
}

/// A face that uses a bad vertex is an error; those that no face uses go.
void MeshBuilder::remove_bad_vertices() {
  if (bad_vertices_.empty()) return;
  constexpr std::uint32_t kGood = 0, kBad = 1;
  std::vector<std::uint32_t> index(vertices_.size(), kGood);
  for (const BadVertex& bad : bad_vertices_) index[bad.index] = kBad;
  for (const Triangle& triangle : triangles_) {
    for (const std::uint32_t corner : triangle) {
      if (index[corner] == kGood) continue;
      fail_at(*std::ranges::lower_bound(bad_vertices_, corner, {}, &BadVertex::index));
    }
  }
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < vertices_.size(); ++i) {
    if (index[i] == kBad) continue;
    vertices_[kept] = vertices_[i];
    index[i] = kept++;
  }
  vertices_.resize(kept);
  for (Triangle& triangle : triangles_) {
    for (std::uint32_t& corner : triangle) corner = index[corner];
  }
  const BadVertex& first = bad_vertices_.front();
  remarks_.push_back(fmt::format(
      "{}: {} {} that no face uses {} invalid, the first being {}; left out", first.place.text(),
      bad_vertices_.size(), bad_vertices_.size() == 1 ? "vertex" : "vertices",
      bad_vertices_.size() == 1 ? "is" : "are", to_text(first.p_file)));
}

TriangleMesh MeshBuilder::finish() && {
  triangulate_waiting();
  remove_bad_vertices();
  if (small_faces_ > 0) {
    add_remark(fmt::format("{} {} fewer than three corners; left out", small_faces_,
                           small_faces_ == 1 ? "face has" : "faces have"));
  }
  const std::size_t found = triangles_.size();
  TriangleMesh mesh(std::move(vertices_), std::move(triangles_), file_);
  if (!mesh.empty()) return mesh.with_remarks(std::move(remarks_));
  throw bad_input(file_, found == 0 ? "has no triangles; expected at least one"
                                    : fmt::format("has {} triangles, none of them with an area; "
                                                  "expected at least one",
                                                  found));
}

}  // namespace vantage::raycore::detail
