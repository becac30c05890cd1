// Mesh files that are not quite right, but leave no doubt: they are read, and a remark says what
// was odd.
#include <doctest/doctest.h>

#include <vantage/raycore/mesh_io.hpp>

#include "raycore/mesh_samples.hpp"
#include "support/expect_error.hpp"
#include "support/non_finite.hpp"
#include "support/test_data.hpp"

using namespace vantage;
using test::replaced;

namespace {

/// Expects the tetrahedron of mesh_samples.hpp and one remark with these parts.
void expect_remark(std::string_view name, std::string_view bytes,
                   std::initializer_list<std::string_view> parts) {
  const test::TemporaryFolder folder;
  const TriangleMesh mesh = read_mesh(folder.write(name, bytes));
  CHECK(mesh.triangles().size() == 4);
  CHECK(mesh.vertices().size() >= 4);
  REQUIRE(mesh.remarks().size() == 1);
  test::check_parts(mesh.remarks()[0], {name});
  test::check_parts(mesh.remarks()[0], parts);
}

}  // namespace

TEST_CASE("bytes behind the end of an STL") {
  const std::string binary = test::stl_binary();
  expect_remark("a.stl", binary + "\r\n", {"2 bytes follow the last of the 4 triangles"});
  expect_remark("a.stl", binary + std::string(100, '\0'), {"100 bytes"});
  expect_remark("a.stl", test::stl_ascii() + "more", {"line 31", "\"more\""});
  expect_remark("a.stl", test::stl_ascii() + std::string(3, '\0'), {"behind the last solid"});
}

TEST_CASE("more behind the last element of a PLY") {
  expect_remark("a.ply", test::ply("ascii") + "3\n", {"more after the last element"});
  expect_remark("a.ply", test::ply("binary_little_endian") + "more", {"more after"});
  expect_remark("a.ply", replaced(test::ply("ascii"), "edge 2", "edge 1"), {"is a count wrong?"});
  const test::TemporaryFolder folder;
  const auto file = folder.write("a.ply", test::ply("binary_big_endian") + "\r\n");
  CHECK(read_mesh(file).remarks().empty());  // some programs end it with a line
}

TEST_CASE("vertices that are not finite matter only to faces that use them") {
  const std::string obj = test::obj_text();
  expect_remark("a.obj", obj + "v nan 0 0\nv 0 inf 0\n", {"a.obj:15", "2 vertices", "nan"});
  expect_remark("a.obj",
                "v 0 0 -1e9\n" + replaced(replaced(replaced(obj, "f 1 3 2", "f 2 4 3"),
                                                   "f 1/1 2/1 4/1", "f 2 3 5"),
                                          "f 2//1 3//1 4//1", "f 3 4 5"),
                {"a.obj:1", "1 vertex that no face uses is invalid"});
  std::string ply = replaced(test::ply("ascii"), "vertex 4", "vertex 5");
  ply = replaced(ply, "0 0 1 7\n", "0 0 1 7\nnan nan 0 7\n");
  expect_remark("a.ply", ply, {"a.ply:20"});
}

TEST_CASE("faces of two corners and of one are left out") {
  expect_remark("a.obj", test::obj_text() + "f 1 2\nf 3\n", {"2 faces have fewer than three"});
  expect_remark(
      "a.off",
      "OFF\n4 5 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n2 0 1\n",
      {"1 face has fewer"});
}

TEST_CASE("remarks stay with moved and scaled copies") {
  const test::TemporaryFolder folder;
  const TriangleMesh mesh = read_mesh(folder.write("a.stl", test::stl_binary() + "xx"));
  REQUIRE(mesh.remarks().size() == 1);
  CHECK(mesh.scaled(2).remarks()[0] == mesh.remarks()[0]);
  CHECK(mesh.transformed(Pose::from_translation({1, 2, 3})).remarks()[0] == mesh.remarks()[0]);
}

TEST_CASE("the strips of a PLY become triangles that look to one side") {
  const std::string text =
      "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int vertex_indices\n"
      "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
      "8 0 1 2 3 -1 3 2 1\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n";
  const test::TemporaryFolder folder;
  const TriangleMesh mesh = read_mesh(folder.write("a.ply", text));
  CHECK(mesh.triangles() == std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}, {3, 2, 1}});
  CHECK(mesh.remarks().empty());
}
