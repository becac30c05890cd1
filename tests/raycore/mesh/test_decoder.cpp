// Formats that assimp reads, in a process of its own.
#include <doctest/doctest.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <thread>
#include <vantage/raycore/mesh_io.hpp>

#include "mesh/decoder/child_process.hpp"
#include "raycore/mesh_samples.hpp"
#include "support/expect_error.hpp"
#include "support/test_data.hpp"

using namespace vantage;
using raycore::detail::ChildProcess;

namespace {

/// One triangle: (1, 2, 3), (4, 2, 3), (1, 5, 3) in the file.
std::string collada(const std::string& asset) {
  return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
         "version=\"1.4.1\"><asset>" +
         asset +
         "</asset><library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array "
         "id=\"a\" "
         "count=\"9\">1 2 3 4 2 3 1 5 3</float_array><technique_common><accessor source=\"#a\" "
         "count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" "
         "type=\"float\"/>"
         "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices "
         "id=\"v\">"
         "<input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"1\"><input "
         "semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 "
         "2</p></triangles></mesh></geometry>"
         "</library_geometries><library_visual_scenes><visual_scene id=\"s\"><node id=\"n\">"
         "<instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes><scene>"
         "<instance_visual_scene url=\"#s\"/></scene></COLLADA>";
}

Eigen::Vector3f first_corner(const std::string& asset, const MeshFileFrame& frame = {}) {
  const test::TemporaryFolder folder;
  return read_mesh(folder.write("a.DAE", collada(asset)), frame).corner(0, 0);
}

std::string end_of(const raycore::detail::ChildLimits& limits,
                   const std::function<void(int)>& work) {
  ChildProcess child(limits, "test", work);
  std::uint8_t byte = 0;
  CHECK(child.read({&byte, 1}) == 0);
  return child.end();
}

}  // namespace

TEST_CASE("a DAE stands by its own up axis, whatever assimp makes of it") {
  CHECK(first_corner("<up_axis>Z_UP</up_axis>") == Eigen::Vector3f(1, 2, 3));
  CHECK(first_corner("<up_axis>Y_UP</up_axis>") == Eigen::Vector3f(1, -3, 2));
  CHECK(first_corner("<up_axis> X_UP </up_axis>") == Eigen::Vector3f(-2, -3, 1));
  CHECK(first_corner("") == Eigen::Vector3f(1, -3, 2));  // COLLADA's default
  CHECK(first_corner("<!-- <up_axis>X_UP</up_axis> --><up_axis>Z_UP</up_axis>") ==
        Eigen::Vector3f(1, 2, 3));
}

TEST_CASE("the user's up axis goes before the file's") {
  const std::string asset = "<up_axis>Y_UP</up_axis>";
  CHECK(first_corner(asset, {1, UpAxis::z}) == Eigen::Vector3f(1, 2, 3));
  CHECK(first_corner(asset, {1, UpAxis::x}) == Eigen::Vector3f(-2, -3, 1));
  CHECK(first_corner(asset, {1, UpAxis::minus_z}) == Eigen::Vector3f(1, -2, -3));
  CHECK(first_corner(asset, {1, UpAxis::minus_y}) == Eigen::Vector3f(1, 3, -2));
  CHECK(first_corner(asset, {1, UpAxis::minus_x}) == Eigen::Vector3f(-2, 3, -1));
}

TEST_CASE("a DAE's unit makes metres, and unit_m comes on top of it") {
  const auto corner = first_corner("<unit meter=\"0.01\"/><up_axis>Z_UP</up_axis>");
  CHECK((corner - Eigen::Vector3f(0.01f, 0.02f, 0.03f)).norm() < 1e-8f);
  const auto half = first_corner("<unit meter=\"0.01\"/><up_axis>Z_UP</up_axis>", {0.5, {}});
  CHECK((half - Eigen::Vector3f(0.005f, 0.01f, 0.015f)).norm() < 1e-8f);
}

TEST_CASE("a 3DS keeps its coordinates, whatever assimp makes of them") {
  const auto chunk = [](std::uint16_t id, const std::string& content) {
    return test::raw(id) + test::raw(std::uint32_t(6 + content.size())) + content;
  };
  std::string points = test::raw(std::uint16_t(3)), face = test::raw(std::uint16_t(1));
  for (const float f : {1, 2, 3, 4, 2, 3, 1, 5, 3}) points += test::raw(f);
  for (const int i : {0, 1, 2, 7}) face += test::raw(std::uint16_t(i));
  const std::string object =
      std::string("part\0", 5) + chunk(0x4100, chunk(0x4110, points) + chunk(0x4120, face));
  const test::TemporaryFolder folder;
  const auto file = folder.write("a.3ds", chunk(0x4D4D, chunk(0x3D3D, chunk(0x4000, object))));
  CHECK(read_mesh(file).corner(0, 0) == Eigen::Vector3f(1, 2, 3));
  CHECK(read_mesh(file, {1, UpAxis::y}).corner(0, 0) == Eigen::Vector3f(1, -3, 2));
}

TEST_CASE("an FBX stands by its own up axis") {
  const auto corner = [](int axis, int sign) {
    const test::TemporaryFolder folder;
    const std::string text = fmt::format(
        "; FBX 7.4.0 project file\nFBXHeaderExtension:  {{\n FBXHeaderVersion: 1003\n FBXVersion: "
        "7400\n"
        "}}\nGlobalSettings:  {{\n Version: 1000\n Properties70:  {{\n  P: \"UpAxis\", \"int\", "
        "\"Integer\", \"\",{}\n  P: \"UpAxisSign\", \"int\", \"Integer\", \"\",{}\n "
        "}}\n}}\nObjects:  {{\n"
        " Geometry: 10, \"Geometry::\", \"Mesh\" {{\n  Vertices: *9 {{\n   a: 1,2,3,4,2,3,1,5,3\n  "
        "}}\n"
        "  PolygonVertexIndex: *3 {{\n   a: 0,1,-3\n  }}\n }}\n"
        " Model: 20, \"Model::part\", \"Mesh\" {{\n  Version: 232\n }}\n}}\nConnections:  {{\n"
        " C: \"OO\",20,0\n C: \"OO\",10,20\n}}\n",
        axis, sign);
    return read_mesh(folder.write("a.fbx", text)).corner(0, 0);
  };
  CHECK(corner(2, 1) == Eigen::Vector3f(1, 2, 3));
  CHECK(corner(1, 1) == Eigen::Vector3f(1, -3, 2));
  CHECK(corner(0, 1) == Eigen::Vector3f(-2, -3, 1));
  CHECK(corner(1, -1) == Eigen::Vector3f(1, 3, -2));
}

TEST_CASE("what assimp refuses is an error with its reason") {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.dae", "a.fbx", "a.3ds", "a.3mf"}) {
    CAPTURE(name);
    test::expect_bad_input(name, "",
                           [&] { read_mesh(folder.write(name, "ply\nformat ascii 1.0\n")); });
    test::expect_bad_input(name, "is empty", [&] { read_mesh(folder.write(name, "")); });
  }
  // Cut at every tenth byte: never more than an error.
  const std::string whole = collada("");
  for (std::size_t size = 1; size < whole.size(); size += whole.size() / 10) {
    test::expect_bad_input("a.dae", "",
                           [&] { read_mesh(folder.write("a.dae", whole.substr(0, size))); });
  }
}

TEST_CASE("a decoder's process may crash, run, wait or write in vain") {
  const raycore::detail::ChildLimits limits = {1, 60, 64 << 20};
  CHECK(end_of(limits, [](int) { std::abort(); }).find("crashed (signal 6)") == 0);
  CHECK(end_of(limits, [](int) { ::_exit(3); }) == "failed (exit code 3)");
  CHECK(end_of(limits, [](int) {
          while (std::chrono::steady_clock::now().time_since_epoch().count() != 0) {
          }
        }).find("took more than 1 s of computing") == 0);
  CHECK(end_of({1, 1, 64 << 20}, [](int) { ::sleep(60); }) == "took more than 1 s");
  CHECK(end_of(limits, [](int) {}) == "");
}

TEST_CASE("what a decoder's process sends arrives, from any thread") {
  std::vector<std::jthread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([t] {
      for (int n = 0; n < 5; ++n) {
        ChildProcess child({5, 20, 64 << 20}, "test", [&](int pipe) {
          const std::vector<std::uint8_t> bytes(300000, std::uint8_t(t));
          raycore::detail::write_to_pipe(pipe, bytes);
        });
        std::vector<std::uint8_t> bytes(300001);
        const std::size_t size = child.read(bytes);
        const bool right = size == 300000 && bytes[299999] == t && child.end().empty();
        CHECK(right);
      }
    });
  }
}

#ifndef VANTAGE_SANITIZED
TEST_CASE("a decoder's process gets no more memory than its limit") {
  ChildProcess child({5, 10, 64 << 20}, "test", [](int pipe) {
    const std::vector<std::uint8_t> bytes(std::size_t(200) << 20, 1);
    raycore::detail::write_to_pipe(pipe, bytes);
  });
  std::uint8_t byte = 0;
  CHECK(child.read({&byte, 1}) == 0);
  CHECK(child.end() == "needed more than 64 MiB of memory");
  CHECK(child.out_of_memory());
}
#endif
