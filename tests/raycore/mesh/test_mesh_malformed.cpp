// Mesh files that are not what they should be: each is refused with the place and what was found.
#include <doctest/doctest.h>

#include <vantage/raycore/mesh_io.hpp>

#include "raycore/mesh_samples.hpp"
#include "support/expect_error.hpp"
#include "support/non_finite.hpp"
#include "support/test_data.hpp"

using namespace vantage;
using test::overwritten;
using test::replaced;

namespace {

void expect_refused(std::string_view name, std::string_view bytes, std::string_view where,
                    std::string_view message) {
  const test::TemporaryFolder folder;
  const auto file = folder.write(name, bytes);
  test::expect_bad_input(where, message, [&] { read_mesh(file); });
}

}  // namespace

TEST_CASE("files that are missing, empty or garbage are refused in every format") {
  const test::TemporaryFolder folder;
  test::expect_bad_input("none.stl", "No such file", [&] { read_mesh(folder / "none.stl"); });
  for (const char* name : {"a.stl", "a.ply", "a.obj"}) {
    expect_refused(name, "", name, "is empty; expected a mesh");
    expect_refused(name, "garbage\n\1\2\3", name, "expected");
    expect_refused(name, "\n\n \n", name, "expected");
  }
}

TEST_CASE("binary STL: a truncated file") {
  std::string bytes = test::stl_binary();
  bytes.pop_back();
  expect_refused("a.stl", bytes, "a.stl, byte 80",
                 "states 4 triangles, which take 284 bytes; the file has 283 and is truncated");
  bytes[0] = 'x';
  expect_refused("a.stl", bytes, "a.stl, byte 80", "is truncated");
  expect_refused("a.stl", bytes.substr(0, 83), "a.stl", "has 83 bytes");
}

TEST_CASE("binary STL: a count beyond the file") {
  std::string bytes = test::stl_binary();
  bytes = overwritten(bytes, 80, "\xff\xff\xff\xff");
  expect_refused("a.stl", bytes, "a.stl, byte 80", "states 4294967295 triangles");
  bytes = overwritten(bytes, 80, std::string(4, '\0'));
  expect_refused("a.stl", bytes, "a.stl, byte 80", "is too long");
  expect_refused("a.stl", bytes.substr(0, 84), "a.stl", "has no triangles");
}

TEST_CASE("binary STL: a vertex that is not finite or too far out") {
  std::string bytes = test::stl_binary();
  bytes = overwritten(bytes, 84 + 50 + 12 + 4, test::raw(test::kNaN));
  expect_refused("a.stl", bytes, "a.stl, triangle 1", "(0, nan, 0)");
  bytes = overwritten(bytes, 84 + 50 + 12 + 4, test::raw(2e6f));
  expect_refused("a.stl", bytes, "a.stl, triangle 1", "expected coordinates below 1e+06 m");
}

TEST_CASE("ASCII STL: every kind of damage is found with its line") {
  const std::string whole = test::stl_ascii();
  expect_refused("a.stl", replaced(whole, "vertex 0 0 0", "vertex 0 nan 0"), "a.stl:4", "nan");
  expect_refused("a.stl", replaced(whole, "vertex 0 1 0", "vertex 0 1"), "a.stl:5",
                 "ends before z");
  expect_refused("a.stl", replaced(whole, "vertex 0 1 0", "vertex 0 1,5 0"), "a.stl:5",
                 "y is \"1,5\"; expected a number");
  expect_refused("a.stl", replaced(whole, "vertex 0 1 0", "vertex 0 1e999 0"), "a.stl:5", "1e999");
  expect_refused("a.stl", replaced(whole, "endloop", "vertex 0 0 0"), "a.stl:7",
                 "\"vertex\" found; expected \"endloop\"");
  expect_refused("a.stl", replaced(whole, "  facet", "  face"), "a.stl:2", "\"face\" found");
  expect_refused("a.stl", whole.substr(0, whole.find("endsolid")), "a.stl:30", "the file ends");
  expect_refused("a.stl", whole.substr(0, whole.find("endloop")), "a.stl:7", "the file ends");
  expect_refused("a.stl", "solid nothing\nendsolid nothing\n", "a.stl", "has no triangles");
}

TEST_CASE("PLY: headers that make no sense are refused with the line") {
  const std::string whole = test::ply("ascii");
  expect_refused("a.ply", replaced(whole, "ply\n", "plx\n"), "a.ply:1", "not \"ply\"");
  expect_refused("a.ply", replaced(whole, "format", "frmt"), "a.ply:2", "expected \"format\"");
  expect_refused("a.ply", replaced(whole, "ascii", "utf8"), "a.ply:2", "\"utf8\"");
  expect_refused("a.ply", replaced(whole, "1.0", "2.0"), "a.ply:2", "version 1.0");
  expect_refused("a.ply", replaced(whole, "comment", "remark"), "a.ply:3", "\"remark\"");
  expect_refused("a.ply", replaced(whole, "vertex 4", "vertex -4"), "a.ply:5", "count \"-4\"");
  expect_refused("a.ply", replaced(whole, "vertex 4", "vertex 4x"), "a.ply:5", "count \"4x\"");
  expect_refused("a.ply", replaced(whole, "element face", "element vertex"), "a.ply:10", "twice");
  expect_refused("a.ply", replaced(whole, "float64 y", "float64 x"), "a.ply:7", "twice");
  expect_refused("a.ply", replaced(whole, "short z", "half z"), "a.ply:8", "\"half\"");
  expect_refused("a.ply", replaced(whole, "short z", "short"), "a.ply:8", "no name");
  expect_refused("a.ply", replaced(whole, "uchar int", "float int"), "a.ply:12", "integer type");
  expect_refused("a.ply", replaced(whole, "element vertex 4\n", ""), "a.ply:5", "before the first");
  expect_refused("a.ply", whole.substr(0, whole.find("end_header")), "a.ply:15", "end_header");
}

TEST_CASE("PLY: what a mesh needs is missed by name") {
  const std::string whole = test::ply("ascii");
  expect_refused("a.ply", replaced(whole, "float x", "float s"), "a.ply", "x, y and z");
  expect_refused("a.ply", replaced(whole, "float x", "list uchar float x"), "a.ply", "x, y and z");
  expect_refused("a.ply", replaced(whole, "vertex_indices", "corners"), "a.ply",
                 "no property \"vertex_indices\"");
  expect_refused("a.ply", replaced(whole, "uchar int", "uchar float"), "a.ply", "list of integers");
  expect_refused("a.ply", replaced(whole, "element vertex", "element point"), "a.ply",
                 "no element \"vertex\"");
  expect_refused("a.ply", replaced(whole, "element face", "element mask"), "a.ply",
                 "has no triangles");
}

TEST_CASE("PLY: a header that claims more than the file holds is refused before memory is taken") {
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    CAPTURE(format);
    const std::string whole = test::ply(format);
    for (const char* count : {"200", "4000000000", "9223372036854775807"}) {
      expect_refused("a.ply", replaced(whole, "vertex 4", std::string("vertex ") + count), "a.ply",
                     std::string("the header claims ") + count + " of the element \"vertex\"");
      expect_refused("a.ply", replaced(whole, "face 4", std::string("face ") + count), "a.ply",
                     "of the element \"face\"");
    }
    expect_refused("a.ply", replaced(whole, "property uint32 length\n", ""), "a.ply",
                   "the element \"edge\" has no properties");
    expect_refused("a.ply", whole.substr(0, whole.size() - 3), "a.ply", "truncated");
  }
  expect_refused("a.ply", replaced(test::ply("ascii"), "vertex 4", "vertex 99999999999999999999"),
                 "a.ply:5", "99999999999999999999");
}

TEST_CASE("ASCII PLY: every kind of damage is found with its line") {
  const std::string whole = test::ply("ascii");  // the data begins at line 16
  expect_refused("a.ply", replaced(whole, "0 0 1 7", "0 nan 1 7"), "a.ply:19", "(0, nan, 1)");
  expect_refused("a.ply", replaced(whole, "0 0 1 7", "0 inf 1 7"), "a.ply:19", "finite");
  expect_refused("a.ply", replaced(whole, "0 0 1 7", "0 0 1"), "a.ply:19", "expected a number");
  expect_refused("a.ply", replaced(whole, "0 0 1 7", "0 0 one 7"), "a.ply:19", "\"one\"");
  expect_refused("a.ply", replaced(whole, "0 0 1 7", "0 0 1 7 8"), "a.ply:19", "\"8\" follows");
  expect_refused("a.ply", replaced(whole, "3 1 2 3", "3 1 2 4"), "a.ply:22",
                 "vertex 4; expected 0 or more and less than 4");
  expect_refused("a.ply", replaced(whole, "3 1 2 3", "3 1 2 -1"), "a.ply:22", "vertex -1");
  expect_refused("a.ply", replaced(whole, "3 1 2 3", "3 1 2 0.5"), "a.ply:22", "vertex 0.5");
  expect_refused("a.ply", replaced(whole, "3 1 2 3", "3 1 2 nan"), "a.ply:22", "vertex nan");
  expect_refused("a.ply", replaced(whole, "3 1 2 3", "-3 1 2 3"), "a.ply:22", "length -3");
  expect_refused("a.ply", replaced(whole, "3 1 2 3", "1e18 1 2 3"), "a.ply:22", "length 1e+18");
}

TEST_CASE("binary PLY: every kind of damage is found with its element") {
  for (const bool big : {false, true}) {
    CAPTURE(big);
    const std::string format = big ? "binary_big_endian" : "binary_little_endian";
    const std::string whole = test::ply(format);
    const std::size_t body = whole.find("end_header\n") + 11;
    const std::size_t face_1 = body + 4 * 15 + 31;
    std::string bytes = whole;
    expect_refused("a.ply", overwritten(bytes, body + 15, test::raw(test::kNaN, big)),
                   "a.ply, vertex 1", "(nan, 0, 0)");
    bytes = whole;
    expect_refused("a.ply", overwritten(bytes, face_1 + 19, test::raw(std::int32_t(4), big)),
                   "a.ply, face 1", "vertex 4; expected");
    bytes = whole;
    expect_refused("a.ply", overwritten(bytes, face_1, "\xff\xff"), "a.ply, face 1",
                   "\"quality\" has the length 65535");
    bytes = replaced(whole, "list uchar int", "list char int");
    expect_refused("a.ply", overwritten(bytes, face_1 - 1 + 18, "\xfd"), "a.ply, face 1",
                   "length -3");
    expect_refused("a.ply", whole.substr(0, whole.size() - 1), "a.ply, edge 1", "truncated");
  }
}

TEST_CASE("OBJ: every kind of damage is found with its line") {
  const std::string whole = test::obj_text();
  expect_refused("a.obj", replaced(whole, "v 0 0 1", "v 0 nan 1"), "a.obj:7", "(0, nan, 1)");
  expect_refused("a.obj", replaced(whole, "v 0 0 1", "v 0 0"), "a.obj:7", "ends before z");
  expect_refused("a.obj", replaced(whole, "v 0 0 1", "v 0 0 x"), "a.obj:7", "z is \"x\"");
  expect_refused("a.obj", replaced(whole, "v 0 0 1", "v 0 0 -1e7"), "a.obj:7", "below 1e+06 m");
  expect_refused("a.obj", replaced(whole, "f 1 3 2", "f 1 3 5"), "a.obj:10",
                 "vertex 5; there are 4 vertices before this line");
  expect_refused("a.obj", replaced(whole, "f 1 3 2", "f 1 3 -5"), "a.obj:10", "vertex -5");
  expect_refused("a.obj", replaced(whole, "f 1 3 2", "f 1 3 0"), "a.obj:10", "count from 1");
  expect_refused("a.obj", replaced(whole, "f 1 3 2", "f 1 3 99999999999999999999"), "a.obj:10",
                 "99999999999999999999");
  for (const char* corner : {"2/a", "2/1/1/1", "2.5", "/1", "2x"}) {
    expect_refused("a.obj", replaced(whole, "f 1 3 2", std::string("f 1 3 ") + corner), "a.obj:10",
                   std::string("the corner \"") + corner + "\"; expected");
  }
  expect_refused("a.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "a.obj",
                 "1 triangles, none of them with an area");
}

TEST_CASE("what a file puts into a message is shortened and harmless") {
  const std::string text = "v 0 0 " + std::string("\x1b[31m") + std::string(1000, 'x');
  expect_refused("a.obj", text, "a.obj:1", "z is \"?[31mxxxx");
  const test::TemporaryFolder folder;
  try {
    read_mesh(folder.write("a.obj", text));
  } catch (const Error& error) {
    CHECK(error.message().size() < 120);
  }
}
