#include <doctest/doctest.h>

#include <vantage/raycore/mesh_io.hpp>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"

using namespace vantage;

namespace {

TriangleMesh read_off_text(std::string_view text) {
  const test::TemporaryFolder folder;
  return read_mesh(folder.write("a.off", text));
}

void expect_square(std::string_view text) {
  CAPTURE(text);
  const TriangleMesh mesh = read_off_text(text);
  CHECK(mesh.triangles() == std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}});
  CHECK(mesh.vertices().at(2) == Eigen::Vector3f(1, 1, 0));
}

void expect_off_refused(std::string_view text, std::string_view where, std::string_view message) {
  test::expect_bad_input(where, message, [&] { read_off_text(text); });
}

}  // namespace

TEST_CASE("an OFF is read with every header that people write") {
  const std::string body = "4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
  expect_square("OFF\n" + body);
  expect_square("OFF" + body);  // glued, as in ModelNet
  expect_square("OFF " + body);
  expect_square(body);  // the keyword is optional
  expect_square("# a comment\nOFF # another\n\n" + body);
  expect_square("OFF\r\n4 1\r\n0 0 0\r\n# between\r\n1 0 0\r\n\r\n1 1 0\r\n0 1 0\r\n4 0 1 2 3");
}

TEST_CASE("colours, normals and texture coordinates of an OFF are passed over") {
  expect_square(
      "COFF\n4 1 0\n0 0 0 255 0 0 255\n1 0 0 1 1 1 1\n1 1 0 0 0 0 0\n0 1 0 0 0 0 0\n4 0 1 2 3 0.5 "
      "0.5 0.5\n");
  expect_square("NOFF\n4 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n4 0 1 2 3 7\n");
  expect_square("STCNOFF 4 1 0\n0 0 0 0 0 1 1 1 1 1 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n4 0 1 2 3\n");
}

TEST_CASE("OFF: what is damaged is refused with its line") {
  const std::string head = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n";
  expect_off_refused(head + "3 0 1 7\n", "a.off:6", "vertex 7; expected 0 or more and less than 3");
  expect_off_refused(head + "3 0 1 -1\n", "a.off:6", "vertex -1");
  expect_off_refused(head + "3 0 1\n", "a.off:6", "corner 2 of 3 is \"\"");
  expect_off_refused(head + "99999999999 0 1 2\n", "a.off:6", "corner 3");
  expect_off_refused(head + "-3 0 1 2\n", "a.off:6", "number of corners is \"-3\"");
  expect_off_refused(head, "a.off:6", "ends after 0 of 1 faces");
  expect_off_refused("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "a.off:4", "ends before z");
  expect_off_refused("OFF\n3000000000 1 0\n", "a.off:2", "claims 3000000000 vertices");
  expect_off_refused("OFF\n1 3.0.3\n", "a.off:2", "number of faces is \"3.0.3\"");
  expect_off_refused("4OFF\n3 1 0\n", "a.off:1", "three-dimensional");
  expect_off_refused("OFF BINARY\n\1\2", "a.off:1", "binary OFF");
  expect_off_refused("solid\n", "a.off:1", "begins with \"solid\"");
  expect_off_refused("OFF\n3 1 0\n0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n", "a.off:4", "nan");
}
