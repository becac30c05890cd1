// OFF, as Geomview describes it: a keyword (OFF, with ST, C and N before it for texture
// coordinates, colours and normals), the numbers of vertices, faces and edges, then a line for each
// vertex and each face ("3 0 1 2": its number of corners, their indices from 0). What follows them
// on their lines is about appearance and passed over; "#" begins a comment.
#include <fmt/format.h>

#include <algorithm>

#include "mesh/mesh_readers.hpp"
#include "mesh/text_scanner.hpp"

namespace vantage::raycore::detail {
namespace {

/// The next word that is no comment's; empty at the text's end.
std::string_view off_word(TextScanner& text) {
  while (true) {
    const std::string_view word = text.word_anywhere();
    if (word.empty() || word.front() != '#') return word;
    if (!text.next_line()) return {};
  }
}

std::uint64_t to_count(std::string_view word, const char* what, const TextScanner& text) {
  const std::optional<std::int64_t> count = to_integer(word);
  if (count && *count >= 0) return std::uint64_t(*count);
  text.fail(
      fmt::format("the number of {} is {}; expected an integer, 0 or more", what, in_quotes(word)));
}

/// Reads the keyword, which some programs glue to the number of vertices; that number or nothing is
/// returned. A file may begin without it.
std::string_view read_keyword(TextScanner& text) {
  TextScanner at_start = text;
  const std::string_view word = off_word(text);
  if (to_integer(word)) {
    text = at_start;
    return {};
  }
  const std::size_t off = word.find("OFF");
  const std::string_view prefix = word.substr(0, std::min(off, word.size()));
  if (off == std::string_view::npos || prefix.find_first_not_of("STCN") != std::string_view::npos) {
    text.fail(
        fmt::format("the file begins with {}; expected OFF, COFF, NOFF, STOFF or several of their "
                    "prefixes (4OFF and nOFF are not three-dimensional)",
                    in_quotes(word)));
  }
  TextScanner ahead = text;
  if (ahead.word() == "BINARY") {
    text.fail("binary OFF is not read; expected text: convert it to PLY");
  }
  return word.substr(off + 3);
}

/// No element takes less than `bytes` of the file: so many can be there at most.
void check_count(std::uint64_t count, std::uint64_t bytes, const char* what, std::uint64_t size,
                 const TextScanner& text) {
  if (count <= size / bytes + 1) return;
  text.fail(
      fmt::format("the header claims {} {}; the file has {} bytes, which cannot hold them: it "
                  "is truncated or damaged",
                  count, what, size));
}

/// Goes to the next line that has something on it.
void go_to_element(TextScanner& text, const char* what, std::uint64_t number, std::uint64_t count) {
  while (true) {
    TextScanner ahead = text;
    const std::string_view word = ahead.word();
    if (!word.empty() && word.front() != '#') return;
    if (text.next_line()) continue;
    text.fail(fmt::format("the file ends after {} of {} {}; it is truncated", number, count, what));
  }
}

void read_off_face(TextScanner& text, std::uint64_t vertex_count, MeshBuilder& mesh,
                   std::vector<std::int64_t>& corners) {
  const std::uint64_t count = to_count(text.word(), "corners", text);
  corners.clear();
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::string_view word = text.word();
    const std::optional<std::int64_t> index = to_integer(word);
    if (!index) {
      text.fail(fmt::format("corner {} of {} is {}; expected a vertex's number", k, count,
                            in_quotes(word)));
    }
    corners.push_back(*index);
  }
  mesh.add_polygon(corners, vertex_count, text.place());
}

}  // namespace

void read_off(std::span<const std::uint8_t> bytes, MeshBuilder& mesh) {
  TextScanner text(as_text(bytes), mesh.file());
  const std::string_view glued = read_keyword(text);
  const std::uint64_t vertices = to_count(glued.empty() ? off_word(text) : glued, "vertices", text);
  const std::uint64_t faces = to_count(off_word(text), "faces", text);
  check_count(vertices, 6, "vertices", bytes.size(), text);
  check_count(faces, 2, "faces", bytes.size(), text);
  mesh.reserve(vertices, faces);
  for (std::uint64_t i = 0; i < vertices; ++i) {
    text.next_line();  // the number of edges, what is about appearance
    go_to_element(text, "vertices", i, vertices);
    const double x = text.number("x");
    const double y = text.number("y");
    const double z = text.number("z");
    mesh.add_vertex({x, y, z}, text.place());
  }
  std::vector<std::int64_t> corners;
  for (std::uint64_t i = 0; i < faces; ++i) {
    text.next_line();
    go_to_element(text, "faces", i, faces);
    read_off_face(text, vertices, mesh, corners);
  }
}

}  // namespace vantage::raycore::detail
