// What a workcell says of candidate views, and of where the camera may be.
#include <doctest/doctest.h>

#include <string>

#include "apps/cell_files.hpp"
#include "documents/schemas.hpp"
#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "workcell/view_list.hpp"
#include "workcell/workcell.hpp"
#include "workcell/workcell_views.hpp"

namespace vantage::test {
namespace {

constexpr std::string_view kViews =
    R"({"views": [{"eye_m": [1, 0, 1], "target_m": [0, 0, 1]},
 {"T_world_cam": {"rotation": {"w": 0, "x": 1, "y": 0, "z": 0}, "translation_m": [0, 0, 2]}}]})";

Workcell load_cell(const TemporaryFolder& folder, const std::string& text) {
  return load_workcell(folder.write("cell.yaml", kAreaLine + text));
}

template <class Kind>
Kind candidates_of(const std::string& text) {
  TemporaryFolder folder;
  const Workcell cell = load_cell(folder, "candidates: " + text + "\n");
  REQUIRE(std::holds_alternative<Kind>(cell.candidates));
  return std::get<Kind>(cell.candidates);
}

void expect_cell_refused(const std::string& text, std::string_view where,
                         std::initializer_list<std::string_view> parts) {
  CAPTURE(text);
  TemporaryFolder folder;
  folder.write("views.json", kViews);
  expect_refused([&] { load_cell(folder, text); }, where, parts);
}

/// The poses of `kViews`.
void expect_views(const std::vector<Pose>& poses) {
  REQUIRE(poses.size() == 2);
  CHECK(poses[0].translation() == Eigen::Vector3d(1, 0, 1));
  CHECK((poses[0].rotation().col(2) - Eigen::Vector3d(-1, 0, 0)).norm() < 1e-12);
  CHECK(poses[1].translation() == Eigen::Vector3d(0, 0, 2));
  CHECK((poses[1].rotation().col(2) - Eigen::Vector3d(0, 0, -1)).norm() < 1e-12);
}

std::string map_bytes(const std::string& shape, const std::string& array) {
  std::string text = "{'descr': '|b1', 'fortran_order': False, 'shape': " + shape + ", }";
  text.resize(118, ' ');
  return std::string("\x93NUMPY\1\0v\0", 10) + text + array;
}

}  // namespace

TEST_CASE("a workcell's half-spheres: a set, and what goes before it") {
  const HalfSpheres none = candidates_of<HalfSpheres>("{}");
  CHECK(none.radii_m.empty());
  CHECK(none.counts == std::vector{20});
  CHECK(none.fan.rings == 0);
  const HalfSpheres full = candidates_of<HalfSpheres>("{set: full}");
  CHECK(full.radii_m.empty());
  CHECK(full.counts == std::vector{456, 456, 457});
  CHECK(full.fan.rings == 2);
  const HalfSpheres two = candidates_of<HalfSpheres>("{set: full, radii_m: [0.5, 0.7]}");
  CHECK(two.radii_m == std::vector{0.5, 0.7});
  CHECK(two.counts == std::vector{684, 685});
  const HalfSpheres own = candidates_of<HalfSpheres>(
      "{radii_m: [0.5, 0.7], count: [10, 30], rings: 1, ring_step_rad: 0.3}");
  CHECK(own.counts == std::vector{10, 30});
  CHECK(own.fan.rings == 1);
  CHECK(own.fan.step_rad == 0.3);
  CHECK(candidates_of<HalfSpheres>("{set: production, count: 7}").counts == std::vector{7});
}

TEST_CASE("the full set shares its positions out among any radii") {
  for (std::size_t radii = 1; radii <= 16; ++radii) {
    const HalfSpheres set = half_spheres_of("full", std::vector<double>(radii, 0.5));
    REQUIRE(set.counts.size() == radii);
    int total = 0;
    for (const int count : set.counts) {
      total += count;
      CHECK(std::abs(count - 1369 / double(radii)) < 1);
    }
    CHECK(total == 1369);
  }
  CHECK(half_spheres_of("production", {0.5, 0.6, 0.7}).counts == std::vector{20});
}

TEST_CASE("a workcell's other kinds of candidates") {
  const BoxGrid grid = candidates_of<BoxGrid>(
      "{box_grid: {min_m: [0, 0, 1], max_m: [1, 2, 3], counts: [3, 4, 5], rings: 1}}");
  CHECK(grid.box.max() == Eigen::Vector3d(1, 2, 3));
  CHECK(grid.counts == Eigen::Vector3i(3, 4, 5));
  CHECK(grid.fan.rings == 1);
  CHECK(grid.fan.step_rad == ViewFan().step_rad);
  const std::string views =
      "[{eye_m: [1, 0, 1], target_m: [0, 0, 1]}, {T_world_cam: {rotation: {w: 0, x: 1, y: 0, z: 0},"
      " translation_m: [0, 0, 2]}}]";
  const AroundPath around =
      candidates_of<AroundPath>("{around_path: {path: " + views + ", step_m: 0.2, count: 3}}");
  expect_views(around.path);
  CHECK(around.step_m == 0.2);
  CHECK(around.radius_m == AroundPath().radius_m);
  CHECK(around.count == 3);
  expect_views(candidates_of<ViewList>("{views: " + views + "}").poses);
}

TEST_CASE("views and paths may be files, JSON or YAML") {
  TemporaryFolder folder;
  const auto json = folder.write("views.json", kViews);
  expect_views(read_view_file(json));
  const Workcell cell = load_cell(folder, "candidates: {views: views.json}\n");
  expect_views(std::get<ViewList>(cell.candidates).poses);
  CHECK(cell.files == std::vector{folder / "cell.yaml", json});
  folder.write("path.yaml",
               "views:\n  - {eye_m: [1, 0, 1], target_m: [0, 0, 1]}\n"
               "  - T_world_cam: {rotation: {w: 0, x: 1, y: 0, z: 0}, translation_m: [0, 0, 2]}\n");
  const Workcell path = load_cell(folder, "candidates: {around_path: {path: path.yaml}}\n");
  expect_views(std::get<AroundPath>(path.candidates).path);
}

TEST_CASE("invalid candidates are refused") {
  const auto with = [](const char* text) { return "candidates: " + std::string(text) + "\n"; };
  expect_cell_refused(with("{views: views.json, rings: 1, set: full}"), "cell.yaml:2: candidates",
                      {"views, set, rings", "one of"});
  expect_cell_refused(with("{views: views.json, around_path: {path: views.json}}"),
                      "cell.yaml:2: candidates", {"around_path, views"});
  expect_cell_refused(with("{set: all}"), "candidates.set", {"\"all\"", "\"full\""});
  expect_cell_refused(with("{count: [20, 0]}"), "candidates.count[1]", {"found 0", ">= 1"});
  expect_cell_refused(with("{count: 2.5}"), "candidates.count", {"2.5"});
  expect_cell_refused(with("{rings: 51}"), "candidates.rings", {"51", "<= 50"});
  expect_cell_refused(with("{ring_step_rad: 0}"), "candidates.ring_step_rad", {"found 0"});
  expect_cell_refused(with("{box_grid: {min_m: [0, 0, 0], max_m: [1, 1, 0], counts: [1, 1, 1]}}"),
                      "candidates.box_grid", {"min < max"});
  expect_cell_refused(with("{box_grid: {min_m: [0, 0, 0], max_m: [1, 1, 1], counts: [1, 0, 1]}}"),
                      "candidates.box_grid.counts[1]", {"found 0"});
  expect_cell_refused(with("{views: []}"), "candidates.views", {"[]"});
  expect_cell_refused(with("{views: other.json}"), "candidates.views", {"no file", "other.json"});
  expect_cell_refused(with("{views: [{eye_m: [0, 0, 0]}]}"), "candidates.views[0]",
                      {"\"T_world_cam\"", "\"eye_m\" with \"target_m\""});
  expect_cell_refused(with("{views: [{eye_m: [0, 0, 1], target_m: [0, 0, 1]}]}"),
                      "candidates.views[0].target_m", {"coincides"});
  expect_cell_refused(with("{views: [{T_world_cam: {rotation: {w: 1, x: 1, y: 0, z: 0}}}]}"),
                      "candidates.views[0].T_world_cam.rotation", {"norm"});
}

TEST_CASE("an invalid file of views is refused with its own place") {
  TemporaryFolder folder;
  const auto refuses = [&](const std::string& text, std::string_view where, std::string_view part) {
    expect_refused([&] { read_view_file(folder.write("v.yaml", text)); }, where, {part});
  };
  refuses("views: []\n", "v.yaml:1: views", "1 or more");
  refuses("poses: []\n", "v.yaml:1: poses", "keys here are views");
  refuses("views:\n  - {eye: [0, 0, 1]}\n", "v.yaml:2: views[0].eye", "\"eye_m\"");
  refuses("views:\n  - {T_world_cam: {translation_m: [0, 0]}}\n",
          "v.yaml:2: views[0].T_world_cam.translation_m", "3 numbers");
  expect_refused([&] { read_view_file(folder / "none.yaml"); }, "none.yaml", {"o such file"});
}

TEST_CASE("views of workcells and of files are the same") {
  for (const char* name : {"view", "pose", "vector"}) {
    CAPTURE(name);
    CHECK(views_schema()["definitions"][name] == workcell_schema()["definitions"][name]);
  }
}

TEST_CASE("a workcell's limits are read") {
  TemporaryFolder folder;
  folder.write("maps/reach.npy", map_bytes("(1, 2, 3)", std::string("\1\0\0\0\0\1", 6)));
  const Workcell cell =
      load_cell(folder,
                "reach:\n  shell: {base_m: [1, 2, 3], max_m: 0.9}\n"
                "  box: {min_m: [0, 0, 0], max_m: [1, 2, 3]}\n"
                "  map: {file: maps/reach.npy, origin_m: [-1, 0, 0], cell_m: 0.5}\n"
                "view_cone: {half_angle_rad: 1.2}\nclearance_m: 0.03\n"
                "camera_body: {box: {min_m: [-0.1, -0.1, -0.1], max_m: [0.1, 0.1, 0]}}\n");
  const ViewConstraints& limits = cell.constraints;
  REQUIRE(limits.reach);
  CHECK(limits.reach->base_m == Eigen::Vector3d(1, 2, 3));
  CHECK(limits.reach->min_m == 0);
  CHECK(limits.reach_box->max() == Eigen::Vector3d(1, 2, 3));
  REQUIRE(limits.reach_map != nullptr);
  CHECK(limits.reach_map->size == Eigen::Vector3i(1, 2, 3));
  CHECK(limits.reach_map->contains({-0.9, 0.1, 0.1}));
  CHECK_FALSE(limits.reach_map->contains({-0.9, 0.1, 0.6}));
  CHECK(limits.reach_map->contains({-0.9, 0.6, 1.1}));
  CHECK(limits.view_cone->axis == Eigen::Vector3d(0, 0, -1));
  CHECK(limits.view_cone->half_angle_rad == 1.2);
  CHECK(limits.clearance_m == 0.03);
  REQUIRE(std::holds_alternative<BoxBody>(limits.body));
  CHECK(std::get<BoxBody>(limits.body).box.max() == Eigen::Vector3d(0.1, 0.1, 0));
  CHECK(cell.files == std::vector{folder / "cell.yaml", folder / "maps/reach.npy"});

  const Workcell ball = load_cell(folder, "camera_body: {sphere: {radius_m: 0.07}}\n");
  CHECK(std::get<SphereBody>(ball.constraints.body).radius_m == 0.07);
  CHECK(ball.constraints.clearance_m == 0.02);
  const Workcell old = load_cell(folder, "reach: {base_m: [1, 2, 3], min_m: 0.1, max_m: 0.9}\n");
  CHECK(old.constraints.reach->min_m == 0.1);
}

TEST_CASE("a workcell names the camera's body, says that there is none, or leaves the usual one") {
  TemporaryFolder folder;
  const auto is_d435 = [](const ViewConstraints& limits) {
    const BoxBody* body = std::get_if<BoxBody>(&limits.body);
    return body != nullptr && body->box.min() == d435_body().box.min() &&
           body->box.max() == d435_body().box.max();
  };
  CHECK(is_d435(load_cell(folder, "").constraints));
  CHECK(is_d435(load_cell(folder, "camera_body: d435\n").constraints));
  const Workcell none = load_cell(folder, "camera_body: none\nclearance_m: 0\n");
  CHECK(std::holds_alternative<std::monostate>(none.constraints.body));
  CHECK(none.constraints.clearance_m == 0);

  const auto cell =
      folder.write("cell.yaml", std::string(kAreaLine) + "view_cone: {half_angle_rad: 1}\n");
  const ViewConstraints bare = load_workcell(cell, ViewConstraints::bare()).constraints;
  CHECK(std::holds_alternative<std::monostate>(bare.body));
  CHECK(bare.clearance_m == 0);
  CHECK(bare.view_cone);
  const auto named = folder.write("cell.yaml", std::string(kAreaLine) + "camera_body: d435\n");
  const ViewConstraints body = load_workcell(named, ViewConstraints::bare()).constraints;
  CHECK(is_d435(body));
  CHECK(body.clearance_m == 0);
}

TEST_CASE("invalid limits are refused") {
  expect_cell_refused("reach: {shell: {base_m: [0, 0, 0], min_m: 2, max_m: 1}}\n",
                      "cell.yaml:2: reach.shell", {"min_m: 2", "max_m: 1"});
  expect_cell_refused("reach: {base_m: [0, 0, 0]}\n", "reach.max_m", {"missing", "outer sphere"});
  expect_cell_refused("reach: {max_m: 1}\n", "reach.max_m", {"box, map, shell"});
  expect_cell_refused("reach: {}\n", "reach", {"found {}"});
  expect_cell_refused("reach: {box: {min_m: [0, 0, 0], max_m: [1, 1, 0]}}\n", "reach.box",
                      {"min < max"});
  expect_cell_refused("reach: {map: {file: none.npy, origin_m: [0, 0, 0], cell_m: 1}}\n",
                      "reach.map.file", {"no file", "none.npy"});
  expect_cell_refused("reach: {map: {file: views.json, origin_m: [0, 0, 0], cell_m: 1}}\n",
                      "views.json", {"not a NumPy array"});
  expect_cell_refused("reach: {map: {file: views.json, origin_m: [0, 0, 0], cell_m: 0}}\n",
                      "reach.map.cell_m", {"found 0"});
  expect_cell_refused("view_cone: {axis: [0, 0, 0], half_angle_rad: 1}\n", "view_cone",
                      {"[0, 0, 0]"});
  expect_cell_refused("view_cone: {axis: [0, 0, 1]}\n", "view_cone.half_angle_rad", {"missing"});
  expect_cell_refused("view_cone: {half_angle_rad: 4}\n", "view_cone.half_angle_rad", {"found 4"});
  expect_cell_refused("camera_body: {}\n", "camera_body",
                      {"exactly one of the keys \"sphere\", \"box\""});
  expect_cell_refused("camera_body: d436\n", "camera_body",
                      {"found \"d436\"",
                       "one of \"d435\", \"none\", or exactly one of the keys "
                       "\"sphere\", \"box\""});
  expect_cell_refused("camera_body: 7\n", "camera_body", {"found 7", "a string or an object"});
  expect_cell_refused("camera_body: {sphere: {radius_m: 0}}\n", "camera_body.sphere.radius_m",
                      {"found 0"});
  expect_cell_refused("clearance_m: -1\n", "clearance_m", {"found -1"});
}

}  // namespace vantage::test
