#include "evaluate/planning/planning_cell.hpp"

#include <doctest/doctest.h>

#include <cstring>

#include "apps/cell_files.hpp"
#include "support/test_data.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::test {
namespace {

PlanningCell load(const std::filesystem::path& file, const std::string& rest,
                  DepthKind usual = DepthKind::none) {
  return load_planning_cell(planning_cell_name(file.string() + rest), usual, 0);
}

template <class Work>
void expect_refusal(const Work& work, const std::string& where, const std::string& message) {
  try {
    work();
    FAIL("nothing was thrown");
  } catch (const Error& error) {
    CAPTURE(error.what());
    CHECK(error.code() == ErrorCode::bad_input);
    CHECK(error.where().find(where) != std::string::npos);
    CHECK(error.message().find(message) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("a scene's name: the file, its cameras, its depth images") {
  const PlanningCellName plain = planning_cell_name("cells/wall.yaml");
  CHECK(plain.workcell == "cells/wall.yaml");
  CHECK(plain.cameras.empty());
  CHECK_FALSE(plain.depth);

  const PlanningCellName all = planning_cell_name("a:b/c++/wall.yaml:top,left side+noisy");
  CHECK(all.workcell == "a:b/c++/wall.yaml");
  CHECK(all.cameras == std::vector<std::string>{"top", "left side"});
  CHECK(all.depth == DepthKind::noisy);

  const TemporaryFolder folder;
  const auto file = folder.write("a:b+c.yaml", "");
  CHECK(planning_cell_name(file.string()).workcell == file);
  CHECK(planning_cell_name(file.string() + ":d+none").cameras == std::vector<std::string>{"d"});
}

TEST_CASE("an invalid scene name is refused") {
  expect_refusal([] { planning_cell_name("wall.yaml+some"); }, "depth images",
                 "found \"some\"; expected one of: none, ideal, noisy");
  expect_refusal([] { planning_cell_name(":side"); }, "':side'", "expected FILE[:CAMERA");
  expect_refusal([] { planning_cell_name(""); }, "''", "expected FILE");
}

TEST_CASE("a cell has the requested cameras, in that order, and only known objects") {
  const PlanningCell both = load(shipped_workcell("corridor"), ":right,left");
  CHECK(both.name == "corridor:right,left");
  CHECK(both.depth == "none");
  REQUIRE(both.world.cameras.size() == 2);
  CHECK(both.world.cameras[0].name == "right");
  CHECK(both.world.cameras[0].camera.centre().x() > 0);
  CHECK(both.world.cameras[1].depth == nullptr);
  CHECK(both.cameras().size() == 2);
  // From the sides nobody can recognise the gray cube between the walls; from above one can.
  CHECK(both.world.objects.size() == 8);
  for (const KnownObject& object : both.world.objects) CHECK(object.name != "gray");
  CHECK(both.world.static_structures.size() == 4);
  CHECK(both.scene.bodies().size() == 1 + 4 + 9);  // with the board
  CHECK(both.files.front() == shipped_workcell("corridor"));
  const PlanningCell all = load(shipped_workcell("corridor"), "");
  CHECK(all.world.cameras.size() == 4);
  CHECK(all.world.objects.size() == 9);
}

TEST_CASE("foreign objects are in the depth images, and nowhere else") {
  const PlanningCell blind = load(shipped_workcell("foreign_objects"), "");
  CHECK(blind.world.objects.empty());
  CHECK(blind.scene.bodies().size() > 10);
  const PlanningCell seeing = load(shipped_workcell("foreign_objects"), "+ideal");
  CHECK(seeing.name == "foreign_objects:front+ideal");
  REQUIRE(seeing.world.cameras[0].depth != nullptr);
  const PlanningCell usual = load(shipped_workcell("foreign_objects"), "", DepthKind::noisy);
  CHECK(usual.name == "foreign_objects:front+noisy");
  const auto exact = seeing.world.cameras[0].depth->metres();
  const auto noisy = usual.world.cameras[0].depth->metres();
  REQUIRE(exact.size() == noisy.size());
  CHECK(std::memcmp(exact.data(), noisy.data(), exact.size_bytes()) != 0);  // NaN is unequal to NaN
  CHECK(load(shipped_workcell("foreign_objects"), "+none", DepthKind::noisy).depth == "none");
}

TEST_CASE("in the thesis' cells the camera is a point, unless the workcell gives it a body") {
  const ViewConstraints wall = load(shipped_workcell("wall"), "").request.constraints;
  CHECK(std::holds_alternative<std::monostate>(wall.body));
  CHECK(wall.clearance_m == 0);
  const ViewConstraints example = load(shipped_workcell("example"), "").request.constraints;
  CHECK(std::holds_alternative<BoxBody>(example.body));
  CHECK(example.clearance_m == 0.02);
}

TEST_CASE("cells that cannot be evaluated say why") {
  const std::string wall = shipped_workcell("wall").string();
  expect_refusal([&] { load(wall, ":back"); }, wall,
                 "it has no camera \"back\"; expected one or more of: front, top, side");
  expect_refusal([&] { load(wall, ":top,top"); }, wall, "camera \"top\" is named twice");
  expect_refusal([&] { load(wall, ":"); }, wall, "it has no camera \"\"");
  expect_refusal([] { load("nowhere.yaml", ""); }, "nowhere.yaml", "");
  const TemporaryFolder folder;
  const auto bare = folder.write("bare.yaml",
                                 "work_area: {min_m: [0, 0, 0], max_m: [1, 1, 1]}\n"
                                 "known_objects: [{name: a, shape: {sphere: {radius_m: 0.1}}}]\n");
  expect_refusal([&] { load(bare, ""); }, bare.string() + ": cameras", "there are no cameras");
}

}  // namespace vantage::test
