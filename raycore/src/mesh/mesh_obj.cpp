// Wavefront OBJ: "v x y z" and "f corner corner corner …", where a corner is v, v/vt, v//vn or
// v/vt/vn. Indices count from 1; negative ones count back from the last vertex so far. Every other
// keyword is about appearance or free-form surfaces and is passed over.
#include <fmt/format.h>

#include "mesh/mesh_readers.hpp"
#include "mesh/text_scanner.hpp"

namespace vantage::raycore::detail {
namespace {

/// Texture and normal indices are not used, but an invalid corner is found.
bool is_corner_tail(std::string_view tail) {
  if (tail.empty()) return true;
  if (tail.front() != '/') return false;
  const std::string_view texture = tail.substr(1, tail.substr(1).find('/'));
  const std::string_view rest = tail.substr(1 + texture.size());
  const std::string_view normal = rest.empty() ? rest : rest.substr(1);
  return (texture.empty() || to_integer(texture)) && (normal.empty() || to_integer(normal));
}

/// The index, from 0, of the vertex that `corner` names.
std::int64_t vertex_index(std::string_view corner, std::size_t vertex_count,
                          const TextScanner& text) {
  const std::string_view number = corner.substr(0, corner.find('/'));
  const std::optional<std::int64_t> index = to_integer(number);
  if (!index || !is_corner_tail(corner.substr(number.size()))) {
    text.fail(fmt::format("the face has the corner {}; expected v, v/vt, v//vn or v/vt/vn",
                          in_quotes(corner)));
  }
  const auto count = std::int64_t(vertex_count);
  if (*index == 0 || *index > count || *index < -count) {
    text.fail(
        fmt::format("the face has a corner at vertex {}; there are {} vertices before this "
                    "line, and indices count from 1 or back from -1",
                    *index, count));
  }
  return *index > 0 ? *index - 1 : count + *index;
}

void read_face(TextScanner& text, MeshBuilder& mesh, std::vector<std::int64_t>& corners) {
  corners.clear();
  for (std::string_view word = text.word(); !word.empty() && word.front() != '#';
       word = text.word()) {
    corners.push_back(vertex_index(word, mesh.vertex_count(), text));
  }
  mesh.add_polygon(corners, mesh.vertex_count(), text.place());
}

}  // namespace

void read_obj(std::span<const std::uint8_t> bytes, MeshBuilder& mesh) {
  TextScanner text(as_text(bytes), mesh.file());
  std::vector<std::int64_t> corners;
  do {
    const std::string_view keyword = text.word();
    if (keyword == "v") {
      const double x = text.number("x");
      const double y = text.number("y");
      const double z = text.number("z");
      mesh.add_vertex({x, y, z}, text.place());
    } else if (keyword == "f") {
      read_face(text, mesh, corners);
    }
  } while (text.next_line());
}

}  // namespace vantage::raycore::detail
