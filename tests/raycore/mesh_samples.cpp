#include "raycore/mesh_samples.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstdint>

namespace vantage::test {
namespace {

constexpr std::array<std::array<int, 3>, 4> kSampleCorners = {
    {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
constexpr std::array<std::array<int, 3>, 4> kSampleFaces = {
    {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};

std::string words(const std::array<int, 3>& values) {
  return std::to_string(values[0]) + " " + std::to_string(values[1]) + " " +
         std::to_string(values[2]);
}

std::string ply_body_ascii() {
  std::string text;
  for (const auto& p : kSampleCorners) text += words(p) + " 7\n";
  for (const auto& face : kSampleFaces) text += "2 0.5 0.25 3 " + words(face) + "\n";
  return text + "1\n2\n";
}

std::string ply_body_binary(bool big) {
  std::string bytes;
  for (const auto& [x, y, z] : kSampleCorners) {
    bytes += raw(float(x), big) + raw(double(y), big) + raw(std::int16_t(z), big) + "\7";
  }
  for (const auto& face : kSampleFaces) {
    bytes += raw(std::uint16_t(2), big) + raw(0.5, big) + raw(0.25, big) + "\3";
    for (const int index : face) bytes += raw(std::int32_t(index), big);
  }
  return bytes + raw(std::uint32_t(1), big) + raw(std::uint32_t(2), big);
}

}  // namespace

std::string stl_binary() {
  std::string bytes = "solid although binary";
  bytes.resize(80, ' ');
  bytes += raw(std::uint32_t(kSampleFaces.size()));
  for (const auto& face : kSampleFaces) {
    bytes += std::string(12, '\0');
    for (const int index : face) {
      for (const int coordinate : kSampleCorners[std::size_t(index)]) {
        bytes += raw(float(coordinate));
      }
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

std::string stl_ascii() {
  std::string text = "solid a name\n";
  for (const auto& face : kSampleFaces) {
    text += "  facet normal nan 0 0\n    outer loop\n";
    for (const int index : face) {
      text += "      vertex " + words(kSampleCorners[std::size_t(index)]) + "\n";
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid a name\n";
}

std::string obj_text() {
  return "# a tetrahedron\nmtllib none.mtl\no one\n"
         "v 0 0 0\nv 1.0 0 0 1.0\nv 0 +1e0 0 0.5 0.5 0.5\nv 0 0 1\nvt 0 0\nvn 0 0 1\n"
         "f 1 3 2\nf 1/1 2/1 4/1\nf 2//1 3//1 4//1\nf -4/1/1 -1/1/1 \\\n -2/1/1 # the last\n";
}

std::string ply(const std::string& format) {
  const std::string header =
      "ply\nformat " + format +
      " 1.0\ncomment made by hand\nobj_info nothing\n"
      "element vertex 4\nproperty float x\nproperty float64 y\nproperty short z\n"
      "property uchar red\n"
      "element face 4\nproperty list ushort double quality\n"
      "property list uchar int vertex_indices\n"
      "element edge 2\nproperty uint32 length\nend_header\n";
  return header +
         (format == "ascii" ? ply_body_ascii() : ply_body_binary(format == "binary_big_endian"));
}

std::string overwritten(const std::string& bytes, std::size_t at, const std::string& part) {
  REQUIRE(at + part.size() <= bytes.size());
  return bytes.substr(0, at) + part + bytes.substr(at + part.size());
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

}  // namespace vantage::test
