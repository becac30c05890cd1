// Thousands of damaged mesh files: whatever is in a file, reading it gives a mesh or an Error.
#include <doctest/doctest.h>

#include <random>
#include <vantage/raycore/error.hpp>
#include <vantage/raycore/mesh_io.hpp>

#include "raycore/mesh_samples.hpp"
#include "support/test_data.hpp"

using namespace vantage;

namespace {

// The standard fixes what the engine gives, not what its distributions make of it.
std::size_t below(std::mt19937& random, std::size_t limit) {
  return random() % limit;
}

std::string damaged(std::string bytes, std::mt19937& random) {
  const std::size_t count = 1 + below(random, 4);
  for (std::size_t i = 0; i < count && !bytes.empty(); ++i) {
    const std::size_t at = below(random, bytes.size());
    const std::size_t length = below(random, 12);
    switch (below(random, 6)) {
      case 0:
        bytes.resize(at);
        break;
      case 1:
        bytes[at] = char(random());
        break;
      case 2:
        bytes[at] = char(bytes[at] ^ (1 << below(random, 8)));
        break;
      case 3:
        bytes.erase(at, length);
        break;
      case 4:
        bytes.insert(at, bytes.substr(below(random, bytes.size()), length));
        break;
      default:
        bytes[at] = "0123456789-+.e/ \n\xff"[below(random, 18)];
    }
  }
  return bytes;
}

void expect_mesh_or_error(std::string_view name, const std::string& whole, std::uint32_t seed) {
  const test::TemporaryFolder folder;
  std::mt19937 random(seed);
  int refused = 0;
  constexpr int kFiles = 1500;
  for (int i = 0; i < kFiles; ++i) {
    const std::string bytes = damaged(whole, random);
    CAPTURE(i);
    // A new file each time: to write over an old one makes some file systems wait for the disk.
    std::filesystem::remove(folder / name);
    const std::filesystem::path file = folder.write(name, bytes);
    try {
      const TriangleMesh mesh = read_mesh(file, 0.001);
      CHECK_FALSE(mesh.empty());
    } catch (const Error& error) {  // anything else fails the test
      ++refused;
      CHECK(error.where().find(name) != std::string::npos);
      CHECK_FALSE(error.message().empty());
    }
  }
  // Otherwise the damage would be too light, or too heavy, to test anything.
  CHECK(refused > kFiles / 10);
  CHECK(refused < kFiles);
}

}  // namespace

TEST_CASE("damaged binary STL files") {
  expect_mesh_or_error("a.stl", test::stl_binary(), 1);
}
TEST_CASE("damaged ASCII STL files") {
  expect_mesh_or_error("a.stl", test::stl_ascii(), 2);
}
TEST_CASE("damaged ASCII PLY files") {
  expect_mesh_or_error("a.ply", test::ply("ascii"), 3);
}
TEST_CASE("damaged little-endian PLY files") {
  expect_mesh_or_error("a.ply", test::ply("binary_little_endian"), 4);
}
TEST_CASE("damaged big-endian PLY files") {
  expect_mesh_or_error("a.ply", test::ply("binary_big_endian"), 5);
}
TEST_CASE("damaged OBJ files") {
  expect_mesh_or_error("a.obj", test::obj_text(), 6);
}
