#include "workcell/workcell.hpp"

#include <doctest/doctest.h>

#include <string>

#include "apps/cell_files.hpp"
#include "documents/schemas.hpp"
#include "documents/yaml_document.hpp"
#include "support/expect_error.hpp"
#include "support/test_data.hpp"

namespace vantage::test {
namespace {

constexpr std::string_view kStl =
    "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1000 0 0\nvertex 0 1000 0\n"
    "endloop\nendfacet\nendsolid t\n";

Workcell load(const TemporaryFolder& folder, const std::string& text) {
  return load_workcell(folder.write("cell.yaml", text));
}

/// `text` follows a good first line.
void expect_text_refused(const std::string& text, std::string_view where,
                         std::initializer_list<std::string_view> parts) {
  CAPTURE(text);
  TemporaryFolder folder;
  expect_refused([&] { load(folder, kAreaLine + text); }, where, parts);
}

}  // namespace

TEST_CASE("the example has every key of the schema") {
  const nlohmann::json root = read_yaml(shipped_workcell("example")).root;
  const nlohmann::json schema = workcell_schema();
  for (const auto& property : schema["properties"].items()) {
    CAPTURE(property.key());
    CHECK(root.contains(property.key()));
  }
}

TEST_CASE("the example's values arrive") {
  const Workcell cell = load_workcell(shipped_workcell("example"));
  CHECK(cell.work_area.max() == Eigen::Vector3d(0.3, 0.3, 0.4));
  CHECK(cell.movable_intrinsics == Intrinsics{640, 480, 525, 525, 319.5, 239.5});
  REQUIRE(std::holds_alternative<HalfSpheres>(cell.candidates));
  CHECK(std::get<HalfSpheres>(cell.candidates).radii_m == std::vector{0.7, 0.9});
  REQUIRE(cell.constraints.reach);
  CHECK(cell.constraints.reach->base_m == Eigen::Vector3d(0, -0.6, 0));
  CHECK(cell.constraints.reach->min_m == 0.3);
  CHECK(cell.constraints.reach->max_m == 1.8);
  CHECK(cell.constraints.reach_box);
  CHECK(cell.constraints.view_cone);
  CHECK(cell.constraints.clearance_m == 0.02);
  CHECK(std::holds_alternative<BoxBody>(cell.constraints.body));
  REQUIRE(cell.static_structures.size() == 3);
  CHECK(cell.static_structures[1].name == "post");
  REQUIRE(cell.known_objects.size() == 1);
  CHECK(cell.known_objects[0].type->name == "red_cube");
  CHECK(cell.foreign_objects.size() == 1);
  REQUIRE(cell.board);
  CHECK(cell.board->markers.size() == 4);
  CHECK(cell.cameras.size() == 2);
  REQUIRE(cell.random_objects);
  CHECK(cell.random_objects->count == 4);
  CHECK(cell.voxel_size_m == 0.01);
  VolumeOptions resolve_defaults;  // the example has the defaults
  resolve_defaults.anti_alias = false;
  CHECK(cell.volume == resolve_defaults);
}

TEST_CASE("a work area is enough for a workcell") {
  TemporaryFolder folder;
  const Workcell cell = load(folder, kAreaLine);
  CHECK(cell.work_area.min() == Eigen::Vector3d(-1, -2, 0));
  CHECK(cell.work_area.max() == Eigen::Vector3d(1, 2, 0.5));
  CHECK(cell.sensor_range == DepthRange{});
  CHECK(!cell.movable_intrinsics);
  CHECK(cell.movable_range == DepthRange{});
  REQUIRE(std::holds_alternative<HalfSpheres>(cell.candidates));
  CHECK(std::get<HalfSpheres>(cell.candidates).radii_m.empty());
  CHECK(std::get<HalfSpheres>(cell.candidates).counts == std::vector{20});
  CHECK(!cell.constraints.reach);
  CHECK(!cell.constraints.reach_box);
  CHECK(cell.constraints.reach_map == nullptr);
  CHECK(!cell.constraints.view_cone);
  CHECK(cell.constraints.clearance_m == 0.02);
  CHECK(std::holds_alternative<BoxBody>(cell.constraints.body));
  CHECK(cell.voxel_size_m == 0.009375);
  CHECK(cell.sensor_intrinsics == Intrinsics{640, 480, 615, 615, 319.5, 239.5});
  CHECK(cell.foreign_objects.empty());
  CHECK(!cell.board);
  CHECK(cell.cameras.empty());
  CHECK(!cell.random_objects);
  CHECK(cell.volume == VolumeOptions{});
  CHECK(cell.files == std::vector{folder / "cell.yaml"});
}

TEST_CASE("a workcell's ranges, candidates and reach are read") {
  TemporaryFolder folder;
  const Workcell cell =
      load(folder, kAreaLine +
                       "sensor: {depth_range_m: [0.4, 4]}\n"
                       "movable_camera: {width: 320, height: 240, fx: 300, fy: 301,"
                       " cx: 160, cy: 120, depth_range_m: [0.2, 2]}\n"
                       "candidates: {count: 7}\n"
                       "reach: {base_m: [1, 2, 3], max_m: 0.9}\n");
  CHECK(cell.sensor_range == DepthRange{0.4, 4});
  CHECK(cell.movable_intrinsics == Intrinsics{320, 240, 300, 301, 160, 120});
  CHECK(cell.movable_range == DepthRange{0.2, 2});
  CHECK(std::get<HalfSpheres>(cell.candidates).counts == std::vector{7});
  CHECK(cell.constraints.reach->base_m == Eigen::Vector3d(1, 2, 3));
  CHECK(cell.constraints.reach->min_m == 0);
}

TEST_CASE("a workcell's volume settings are read, and what is not there keeps its default") {
  TemporaryFolder folder;
  const Workcell cell = load(folder, kAreaLine +
                                         "volume:\n"
                                         "  occluders: voxels\n"
                                         "  anti_alias: false\n"
                                         "  band_sigmas: 2.5\n"
                                         "  noise: {focal_px: 640, baseline_m: 0.095}\n");
  CHECK(cell.volume == VolumeOptions{OccluderMode::voxels, false, 2.5, {640, 0.095, 0.08}});
  CHECK(!load(folder, kAreaLine + "volume: {occluders: voxels}\n").volume.anti_alias);
  expect_text_refused("volume: {occluders: boxes}\n", "volume.occluders", {"boxes", "voxels"});
  expect_text_refused("volume: {band_sigmas: -1}\n", "volume.band_sigmas", {"-1"});
  expect_text_refused("volume: {noise: {baseline_m: 0}}\n", "volume.noise.baseline_m", {"0"});
  expect_text_refused("volume: {anti_alais: true}\n", "anti_alais", {"\"anti_alias\""});
}

TEST_CASE("boxes and meshes become objects at their poses") {
  TemporaryFolder folder;
  folder.write("meshes/arm.stl", kStl);
  const Workcell cell =
      load(folder, kAreaLine +
                       "static_structures:\n"
                       "  - {name: wall, box: {min_m: [0, 0, 0], max_m: [1, 2, 3]}}\n"
                       "  - name: arm\n    mesh: meshes/arm.stl\n    unit_m: 0.001\n"
                       "    pose: {rotation: {w: 0.70710678, x: 0, y: 0, z: 0.70710678},\n"
                       "           translation_m: [9, 0, 0]}\n"
                       "known_objects:\n"
                       "  - {name: tin, mesh: meshes/arm.stl}\n");
  REQUIRE(cell.static_structures.size() == 2);
  CHECK(cell.static_structures[0].mesh->triangles().size() == 12);
  CHECK(cell.static_structures[0].T_world_object.translation().norm() == 0);
  const KnownObject arm = cell.static_structures[1].known();
  REQUIRE(arm.mesh->triangles().size() == 1);
  const Eigen::Vector3d corner = arm.mesh->corner(0, 1).cast<double>();
  CHECK((corner - Eigen::Vector3d(1, 0, 0)).norm() < 1e-6);
  CHECK((arm.T_world_object * corner - Eigen::Vector3d(9, 1, 0)).norm() < 1e-6);
  REQUIRE(cell.known_objects.size() == 1);
  CHECK(cell.known_objects[0].mesh->corner(0, 1).x() == 1000);
  CHECK(cell.files == std::vector{folder / "cell.yaml", folder / "meshes/arm.stl"});
}

TEST_CASE("a mesh may be named with its unit and its up axis") {
  TemporaryFolder folder;
  folder.write("arm.stl", kStl);
  const Workcell cell =
      load(folder, kAreaLine +
                       "static_structures:\n"
                       "  - {name: a, mesh: {file: arm.stl, unit_m: 0.001}}\n"
                       "  - {name: b, mesh: {file: arm.stl, up: -x}, unit_m: 0.001}\n"
                       "  - {name: c, shape: {mesh: arm.stl}}\n");
  CHECK(cell.static_structures[0].mesh->corner(0, 1) == Eigen::Vector3f(1, 0, 0));
  CHECK(cell.static_structures[1].mesh->corner(0, 1) == Eigen::Vector3f(0, 0, -1));
  CHECK(cell.static_structures[2].mesh->corner(0, 1) == Eigen::Vector3f(1000, 0, 0));
  expect_text_refused("known_objects:\n  - {name: a, mesh: {file: b.stl, unit_m: 1}, unit_m: 1}\n",
                      "cell.yaml:3: known_objects[0].unit_m", {"remove one"});
}

TEST_CASE("a workcell that is missing or no YAML is refused") {
  TemporaryFolder folder;
  expect_refused([&] { load_workcell(folder / "cell.yaml"); }, "cell.yaml", {"o such file"});
  expect_refused([&] { load(folder, "work_area: 1\n wrong: 2\n"); }, "cell.yaml:2:7",
                 {"invalid YAML"});
}

TEST_CASE("a workcell's keys are checked against the schema") {
  TemporaryFolder folder;
  expect_refused([&] { load(folder, "voxel_size_m: 0.01\n"); }, "cell.yaml:1: work_area",
                 {"missing", "the box in which to look"});
  expect_text_refused("voxel_size: 0.01\n", "cell.yaml:2: voxel_size",
                      {"unknown key", "\"voxel_size_m\""});
  expect_text_refused("voxel_size_m: 0\n", "cell.yaml:2: voxel_size_m",
                      {"found 0", "a number > 0"});
  expect_text_refused("movable_camera: {width: 640, height: 480, fx: -1, fy: 1, cx: 0, cy: 0}\n",
                      "cell.yaml:2: movable_camera.fx", {"found -1", "a number > 0"});
  expect_text_refused("movable_camera: {width: 640, height: 480, fx: 1, fy: 1, cx: 0}\n",
                      "cell.yaml:2: movable_camera.cy", {"missing", "principal point"});
  expect_text_refused("candidates: {radii_m: [0.5, -1]}\n", "cell.yaml:2: candidates.radii_m[1]",
                      {"found -1", "a number > 0"});
  expect_text_refused("candidates: {count: many}\n", "cell.yaml:2: candidates.count",
                      {"found \"many\"", "a whole number or an array >= 1 and <= 1000000"});
  expect_text_refused("sensor: {depth_range_m: [1]}\n", "cell.yaml:2: sensor.depth_range_m",
                      {"found [1]", "2 numbers"});
}

TEST_CASE("boxes and ranges the wrong way round are refused") {
  TemporaryFolder folder;
  expect_refused([&] { load(folder, "work_area: {min_m: [0, 0, 1], max_m: [1, 1, 0]}\n"); },
                 "cell.yaml:1: work_area", {"min < max"});
  expect_text_refused("sensor: {depth_range_m: [3, 0.1]}\n", "cell.yaml:2: sensor.depth_range_m",
                      {"3 to 0.1"});
  expect_text_refused(
      "movable_camera: {width: 640, height: 480, fx: 1, fy: 1, cx: 0, cy: 0,\n"
      "  depth_range_m: [2, 2]}\n",
      "cell.yaml:3: movable_camera.depth_range_m", {"2 to 2"});
  expect_text_refused("reach: {base_m: [0, 0, 0], min_m: 2, max_m: 1}\n", "cell.yaml:2: reach",
                      {"min_m: 2", "max_m: 1"});
}

TEST_CASE("invalid objects are refused") {
  const auto with = [](const std::string& object) {
    return "known_objects:\n  - " + object + "\n";
  };
  const std::string box = "box: {min_m: [0, 0, 0], max_m: [1, 1, 1]}";
  expect_text_refused(with("{name: a}"), "cell.yaml:3: known_objects[0]",
                      {"exactly one of the keys \"box\", \"shape\", \"mesh\", \"type\""});
  expect_text_refused(with("{name: a, mesh: b.stl, " + box + "}"), "cell.yaml:3: known_objects[0]",
                      {"exactly one of the keys"});
  expect_text_refused(with("{" + box + "}"), "cell.yaml:3: known_objects[0].name", {"missing"});
  expect_text_refused(with("{name: a, mesh: b.stl}"), "cell.yaml:3: known_objects[0].mesh",
                      {"no file", "b.stl", "relative"});
  expect_text_refused(with("{name: a, unit_m: 1, " + box + "}"),
                      "cell.yaml:3: known_objects[0].unit_m", {"only a mesh"});
  expect_text_refused(with("{name: a, box: {min_m: [0, 0, 0], max_m: [1, 0, 1]}}"),
                      "cell.yaml:3: known_objects[0].box", {"min < max"});
  expect_text_refused(with("{name: a, " + box + ", pose: {rotation: {w: 1, x: 1, y: 0, z: 0}}}"),
                      "cell.yaml:3: known_objects[0].pose.rotation", {"norm", "expected 1"});
}

TEST_CASE("a name may be there once only") {
  const std::string box = "box: {min_m: [0, 0, 0], max_m: [1, 1, 1]}";
  expect_text_refused("static_structures:\n  - {name: a, " + box +
                          "}\nknown_objects:\n  - {name: a, " + box + "}\n",
                      "cell.yaml:5: known_objects[0].name",
                      {"\"a\"", "cell.yaml:3: static_structures[0].name"});
}

TEST_CASE("a damaged mesh is refused with its own place") {
  TemporaryFolder folder;
  folder.write("a.stl", "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n");
  expect_refused([&] { load(folder, kAreaLine + "known_objects: [{name: a, mesh: a.stl}]\n"); }, "",
                 {""});
}

}  // namespace vantage::test
