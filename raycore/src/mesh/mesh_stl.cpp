// STL. Binary: an 80-byte header, a count, and 50 bytes for each triangle (normal, three corners,
// two bytes of attributes). ASCII: "solid", then "facet … endfacet" for each triangle, "endsolid".
#include <fmt/format.h>

#include <algorithm>

#include "core/byte_order.hpp"
#include "mesh/mesh_readers.hpp"
#include "mesh/text_scanner.hpp"

namespace vantage::raycore::detail {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kTriangleBytes = 50;

std::uint64_t stated_size(std::span<const std::uint8_t> bytes) {
  const auto count = load<std::uint32_t>(bytes.data() + 80, std::endian::little);
  return kHeaderBytes + std::uint64_t(kTriangleBytes) * count;
}

bool equal_ignoring_case(std::string_view word, std::string_view lower) {
  return std::ranges::equal(word, lower, [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? char(a - 'A' + 'a') : a) == b;
  });
}

/// Many binary files begin with "solid", too: the size tells, and no text has a zero byte, unless
/// it comes behind the end.
bool is_binary(std::span<const std::uint8_t> bytes) {
  if (bytes.size() >= kHeaderBytes && stated_size(bytes) == bytes.size()) return true;
  TextScanner text(as_text(bytes), "");
  if (!equal_ignoring_case(text.word_anywhere(), "solid")) return true;
  text.next_line();
  TextScanner ahead = text;
  const std::string_view next = ahead.word_anywhere();
  if (equal_ignoring_case(next, "facet") || equal_ignoring_case(next, "endsolid")) return false;
  return std::ranges::find(bytes, 0) != bytes.end();
}

/// The number of triangles. Bytes that follow them are none of a mesh's: padding, or what a program
/// leaves there for itself.
std::size_t checked_count(std::span<const std::uint8_t> bytes, MeshBuilder& mesh) {
  if (bytes.size() < kHeaderBytes) {
    throw bad_input(mesh.file(),
                    fmt::format("has {} bytes and does not begin with \"solid\"; expected an "
                                "STL file, which has {} bytes or more",
                                bytes.size(), kHeaderBytes));
  }
  const std::uint64_t stated = stated_size(bytes);
  const std::uint64_t count = (stated - kHeaderBytes) / kTriangleBytes;
  if (stated > bytes.size() || (count == 0 && bytes.size() > kHeaderBytes)) {
    throw bad_input(
        mesh.file() + ", byte 80",
        fmt::format("states {} triangles, which take {} bytes; the file has {} and is {}, or is "
                    "not an STL file",
                    count, stated, bytes.size(), stated > bytes.size() ? "truncated" : "too long"));
  }
  if (stated < bytes.size()) {
    mesh.add_remark(
        fmt::format("{} bytes follow the last of the {} triangles that it states; left "
                    "out",
                    bytes.size() - stated, count));
  }
  return std::size_t(count);
}

void read_binary(std::span<const std::uint8_t> bytes, MeshBuilder& mesh) {
  const std::size_t count = checked_count(bytes, mesh);
  mesh.reserve(3 * count, count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint8_t* corner = bytes.data() + kHeaderBytes + i * kTriangleBytes + 12;
    for (int k = 0; k < 3; ++k, corner += 12) {
      mesh.add_vertex(
          {load<float>(corner, std::endian::little), load<float>(corner + 4, std::endian::little),
           load<float>(corner + 8, std::endian::little)},
          {mesh.file(), "triangle", i});
    }
    mesh.add_triangle_of_last_vertices();
  }
}

void expect(TextScanner& text, std::string_view keyword) {
  const std::string_view word = text.word_anywhere();
  if (equal_ignoring_case(word, keyword)) return;
  text.fail(word.empty() ? fmt::format("the file ends; expected \"{}\"", keyword)
                         : fmt::format("{} found; expected \"{}\"", in_quotes(word), keyword));
}

/// What follows "facet".
void read_facet(TextScanner& text, MeshBuilder& mesh) {
  expect(text, "normal");
  // Normals are left unread: some programs write NaN there.
  for (int i = 0; i < 3; ++i) text.word_anywhere();
  expect(text, "outer");
  expect(text, "loop");
  for (int i = 0; i < 3; ++i) {
    expect(text, "vertex");
    const double x = text.number("x");
    const double y = text.number("y");
    const double z = text.number("z");
    mesh.add_vertex({x, y, z}, text.place());
  }
  expect(text, "endloop");
  expect(text, "endfacet");
  mesh.add_triangle_of_last_vertices();
}

/// What follows "solid", which has a name to the end of its line.
void read_solid(TextScanner& text, MeshBuilder& mesh) {
  text.next_line();
  while (true) {
    const std::string_view word = text.word_anywhere();
    if (equal_ignoring_case(word, "facet")) {
      read_facet(text, mesh);
    } else if (equal_ignoring_case(word, "endsolid")) {
      text.next_line();
      return;
    } else if (word.empty()) {
      text.fail("the file ends within a solid; expected \"facet\" or \"endsolid\"");
    } else {
      text.fail(fmt::format("{} found; expected \"facet\" or \"endsolid\"", in_quotes(word)));
    }
  }
}

}  // namespace

void read_stl(std::span<const std::uint8_t> bytes, MeshBuilder& mesh) {
  if (is_binary(bytes)) return read_binary(bytes, mesh);
  TextScanner text(as_text(bytes), mesh.file());
  while (equal_ignoring_case(text.word_anywhere(), "solid")) {
    read_solid(text, mesh);
    const TextScanner behind = text;
    const std::string_view word = text.word_anywhere();
    if (!word.empty() && !equal_ignoring_case(word, "solid")) {
      mesh.add_remark(fmt::format("line {} begins with {} behind the last solid; left out",
                                  text.place().number, in_quotes(word)));
      return;
    }
    text = behind;
  }
}

}  // namespace vantage::raycore::detail
