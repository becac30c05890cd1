#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <vantage/raycore/mesh_io.hpp>

#include "raycore/mesh_samples.hpp"
#include "support/expect_error.hpp"
#include "support/test_data.hpp"

using namespace vantage;

namespace {

TriangleMesh read_bytes(std::string_view name, std::string_view bytes, double unit_m = 1) {
  const test::TemporaryFolder folder;
  return read_mesh(folder.write(name, bytes), unit_m);
}

/// The faces as corners, which is what all formats have in common.
std::vector<std::array<Eigen::Vector3f, 3>> faces(const TriangleMesh& mesh) {
  std::vector<std::array<Eigen::Vector3f, 3>> result;
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
    result.push_back({mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2)});
  }
  return result;
}

void expect_tetrahedron(const TriangleMesh& mesh, float size = 1) {
  const Eigen::Vector3f o(0, 0, 0), x(size, 0, 0), y(0, size, 0), z(0, 0, size);
  const auto found = faces(mesh);
  REQUIRE(found.size() == 4);
  CHECK(found[0] == std::array{o, y, x});
  CHECK(found[1] == std::array{o, x, z});
  CHECK(found[2] == std::array{x, y, z});
  CHECK(found[3] == std::array{o, z, y});
}

}  // namespace

TEST_CASE("a binary STL that begins with solid is read as binary") {
  expect_tetrahedron(read_bytes("a.stl", test::stl_binary()));
}

TEST_CASE("an ASCII STL is read, whatever its normals are") {
  expect_tetrahedron(read_bytes("a.stl", test::stl_ascii()));
}

TEST_CASE("an ASCII STL may have several solids, capitals and other line ends") {
  std::string text;
  for (const char c : test::stl_ascii()) {
    if (c == '\n') text += '\r';
    text += c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c;
  }
  CHECK(read_bytes("a.stl", text + "\r\n" + test::stl_ascii()).triangles().size() == 8);
}

TEST_CASE("a PLY is read in its three formats, past what is not needed") {
  expect_tetrahedron(read_bytes("a.ply", test::ply("ascii")));
  expect_tetrahedron(read_bytes("a.ply", test::ply("binary_little_endian")));
  expect_tetrahedron(read_bytes("a.ply", test::ply("binary_big_endian")));
}

TEST_CASE("a PLY may have every type, any order, and faces before vertices") {
  const std::string header =
      "ply\r\nformat binary_big_endian 1.0\r\nelement face 1\r\n"
      "property list int8 uint16 vertex_index\r\nelement vertex 4\r\nproperty uchar z\r\n"
      "property char x\r\nproperty ushort y\r\nend_header\r\n";
  const std::string body = std::string("\4") + test::raw(std::uint16_t(0), true) +
                           test::raw(std::uint16_t(1), true) + test::raw(std::uint16_t(2), true) +
                           test::raw(std::uint16_t(3), true) + std::string("\310\0\0\0", 4) +
                           std::string("\310\xff\0\0", 4) + std::string("\310\xff\1\0", 4) +
                           std::string("\310\0\1\0", 4);
  const auto found = faces(read_bytes("a.ply", header + body));
  const Eigen::Vector3f a(0, 0, 200), b(-1, 0, 200), c(-1, 256, 200), d(0, 256, 200);
  REQUIRE(found.size() == 2);  // the quadrangle, as a fan
  CHECK(found[0] == std::array{a, b, c});
  CHECK(found[1] == std::array{a, c, d});
}

TEST_CASE("an OBJ is read with all kinds of corners") {
  expect_tetrahedron(read_bytes("a.obj", test::obj_text()));
}

TEST_CASE("polygons of an OBJ become fans") {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 1 0\nf 1 2 3 4 5";
  CHECK(read_bytes("a.obj", text).triangles() ==
        std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
}

TEST_CASE("the ending counts in any case") {
  expect_tetrahedron(read_bytes("A.STL", test::stl_binary()));
  expect_tetrahedron(read_bytes("A.Ply", test::ply("ascii")));
}

TEST_CASE("readers drop faces without area and count them") {
  const TriangleMesh mesh = read_bytes("a.obj", test::obj_text() + "f 1 1 2\n");
  CHECK(mesh.triangles().size() == 4);
  CHECK(mesh.dropped_degenerate() == 1);
}

TEST_CASE("the unit is applied in every format, before rounding") {
  expect_tetrahedron(read_bytes("a.stl", test::stl_binary(), 0.001), 0.001f);
  expect_tetrahedron(read_bytes("a.stl", test::stl_ascii(), 0.001), 0.001f);
  expect_tetrahedron(read_bytes("a.ply", test::ply("ascii"), 0.001), 0.001f);
  expect_tetrahedron(read_bytes("a.obj", test::obj_text(), 0.001), 0.001f);
  // 123456789 is no float; 0.123456789 is rounded once.
  const std::string far = test::replaced(test::obj_text(), "v 1.0 0 0", "v 123456789 0 0");
  CHECK(read_bytes("a.obj", far, 1e-9).vertices().at(1).x() == 0.123456789f);
}

TEST_CASE("an invalid unit is refused") {
  for (const double unit : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity()}) {
    test::expect_bad_input("unit_m", "expected", [&] { read_bytes("a.stl", "", unit); });
  }
}

TEST_CASE("formats without a safe reader are refused by name") {
  for (const char* name : {"a.x", "a.assbin", "a.blend", "a.wrl", "a.xyzzy"}) {
    test::expect_bad_input(name, "convert it", [&] { read_bytes(name, "x"); });
  }
  test::expect_bad_input("a.STEP", "CAD", [] { read_bytes("a.STEP", "x"); });
  test::expect_bad_input("mesh", "the ending \"\"", [] { read_bytes("mesh", "x"); });
}

TEST_CASE("a pointer of Git LFS is named as such") {
  test::expect_bad_input("a.stl", "git lfs pull", [] {
    read_bytes("a.stl", "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 1\n");
  });
}

TEST_CASE("lines may end with CR alone") {
  const auto with_cr = [](std::string text) {
    std::ranges::replace(text, '\n', '\r');
    return text;
  };
  expect_tetrahedron(read_bytes("a.stl", with_cr(test::stl_ascii())));
  expect_tetrahedron(read_bytes("a.ply", with_cr(test::ply("ascii"))));
  expect_tetrahedron(read_bytes("a.obj", with_cr(test::obj_text())));
}
