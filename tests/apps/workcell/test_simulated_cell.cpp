#include "workcell/simulated_cell.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

#include "simulator/placement/collision.hpp"
#include "support/expect_error.hpp"
#include "support/test_data.hpp"

namespace vantage::test {
namespace {

constexpr std::string_view kSimulatedCell =
    "work_area: {min_m: [-0.2, -0.1, 0], max_m: [0.2, 0.1, 0.3]}\n"
    "knowledge_base: types.yaml\n"
    "foreign_objects: [{name: mug, shape: {cup: {radius_m: 0.03, height_m: 0.08, wall_m: 0.004}},\n"
    "                   pose: {translation_m: [0.1, 0, 0.04]}}]\n"
    "known_objects: [{name: red, type: cube, pose: {translation_m: [0, 0, 0.025]}}]\n"
    "static_structures: [{name: table, box: {min_m: [-1, -1, -0.1], max_m: [1, 1, FLOOR]}}]\n";
constexpr std::string_view kBoard =
    "board: {size_m: [0.3, 0.4], thickness_m: 0.02, dictionary: 4X4_50,\n"
    "  markers: [{id: 7, size_m: 0.04, at_m: [AT, 0.1]}]}\n";

std::string replaced(std::string_view text, std::string_view what, std::string_view by) {
  std::string result(text);
  return result.replace(result.find(what), what.size(), by);
}

Workcell load_with_types(const TemporaryFolder& folder, const std::string& text) {
  folder.write("types.yaml",
               "object_types:\n"
               "  - {name: cube, shape: {box: {size_m: [0.05, 0.05, 0.05]}}}\n"
               "  - {name: ball, shape: {sphere: {radius_m: 0.02}}}\n");
  return load_workcell(folder.write("cell.yaml", text));
}

/// With a board on the table, and `more` lines.
Workcell with_board(const TemporaryFolder& folder, const std::string& more = "") {
  return load_with_types(
      folder, replaced(kSimulatedCell, "FLOOR", "-0.02") + replaced(kBoard, "AT", "-0.1") + more);
}

bool close(const PlacedObject& a, const PlacedObject& b) {
  return closer_than(0.0019, CollisionShape(*a.mesh), a.T_world_object, CollisionShape(*b.mesh),
                     b.T_world_object);
}

}  // namespace

TEST_CASE("a simulated cell has the board first, then the lists in their order") {
  TemporaryFolder folder;
  const Workcell workcell = with_board(folder);
  const SimulatedCell cell = simulated_cell(workcell);
  const std::vector<std::pair<BodyKind, std::string>> expected{
      {BodyKind::board, "board"},
      {BodyKind::static_structure, "table"},
      {BodyKind::known_object, "red"},
      {BodyKind::foreign_object, "mug"}};
  REQUIRE(cell.bodies.size() == expected.size());
  REQUIRE(cell.scene.bodies().size() == expected.size());
  CHECK(cell.scene.rays().object_count() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(cell.bodies[i].kind == expected[i].first);
    CHECK(cell.bodies[i].name == expected[i].second);
    CHECK(cell.scene.bodies()[i].name == expected[i].second);
  }
  CHECK(cell.bodies[2].type == workcell.knowledge->find("cube"));
  CHECK(cell.bodies[3].type == nullptr);
  CHECK(cell.scene.bodies()[2].shape->mesh.vertices() ==
        workcell.known_objects[0].mesh->vertices());
}

TEST_CASE("a ray from above meets the board's top at z = 0, a cube's at its height") {
  TemporaryFolder folder;
  const SimulatedCell cell = simulated_cell(with_board(folder));
  const auto from_above = [&](float x, float y) {
    return cell.scene.rays().closest_hit({{x, y, 1}, {0, 0, -1}}).value();
  };
  CHECK(from_above(0.1f, 0.15f).object == 0);
  CHECK(from_above(0.1f, 0.15f).t == doctest::Approx(1));
  CHECK(from_above(0.01f, 0.01f).object == 2);
  CHECK(from_above(0.01f, 0.01f).t == doctest::Approx(0.95));
  CHECK(from_above(0.5f, 0.5f).object == 1);
  CHECK(from_above(0.5f, 0.5f).t == doctest::Approx(1.02));
}

TEST_CASE("the board's markers are printed on its top") {
  TemporaryFolder folder;
  const Workcell workcell = with_board(folder);
  const TexturedMesh board = board_shape(*workcell.board);
  CHECK(board.textured());
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& vertex : board.mesh.vertices()) bounds.extend(vertex);
  CHECK(bounds.min().isApprox(Eigen::Vector3f(-0.15f, -0.2f, -0.02f), 1e-6f));
  CHECK(bounds.max().isApprox(Eigen::Vector3f(0.15f, 0.2f, 0), 1e-6f));
}

TEST_CASE("a marker beyond the board's edge is refused where the board stands") {
  TemporaryFolder folder;
  const Workcell workcell = load_with_types(
      folder, replaced(kSimulatedCell, "FLOOR", "-0.02") + replaced(kBoard, "AT", "-0.14"));
  expect_bad_input("cell.yaml:7: board, marker 7", "beyond the face's edge",
                   [&] { (void)simulated_cell(workcell); });
}

TEST_CASE("an empty cell is refused") {
  TemporaryFolder folder;
  const Workcell empty =
      load_with_types(folder, "work_area: {min_m: [0, 0, 0], max_m: [1, 1, 1]}\n");
  expect_bad_input("workcell", "the cell is empty", [&] { (void)simulated_cell(empty); });
}

TEST_CASE("random objects lie on the board, away from all that stands there") {
  TemporaryFolder folder;
  Workcell cell = with_board(
      folder, "random_objects: {count: 7, types: [ball, cube], seed: 3, upright_share: 1}\n");
  place_random_objects(cell);
  REQUIRE(cell.known_objects.size() == 8);
  std::vector<PlacedObject> all = cell.known_objects;
  all.insert(all.end(), cell.foreign_objects.begin(), cell.foreign_objects.end());
  std::set<std::string> names;
  for (std::size_t i = 0; i < all.size(); ++i) {
    CAPTURE(all[i].name);
    CHECK(names.insert(all[i].name).second);
    for (std::size_t j = 0; j < i; ++j) CHECK(!close(all[i], all[j]));
    const Eigen::Vector3d at = all[i].T_world_object.translation();
    CHECK(std::abs(at.x()) < 0.15);  // the board ends here, the work area at 0.2
    CHECK(std::abs(at.y()) < 0.1);   // the work area ends here, the board at 0.2
  }
  for (const char* name : {"ball 1", "ball 2", "ball 3", "ball 4", "cube 1", "cube 2", "cube 3"}) {
    CHECK(names.contains(name));
  }
  for (const PlacedObject& object : cell.known_objects) {
    const double height_m = object.type->name == "ball" ? 0.02 : 0.025;
    CHECK(object.T_world_object.translation().z() == doctest::Approx(height_m).epsilon(1e-3));
  }
}

TEST_CASE("the same seed places the same objects, another seed others") {
  TemporaryFolder folder;
  const auto first_of = [&](int seed) {
    Workcell cell = with_board(
        folder, "random_objects: {count: 2, types: [cube], seed: " + std::to_string(seed) + "}\n");
    place_random_objects(cell);
    return cell.known_objects.back().T_world_object.translation();
  };
  CHECK(first_of(1) == first_of(1));
  CHECK(first_of(1) != first_of(2));
}

TEST_CASE("without a board, random objects lie on the work area's floor") {
  TemporaryFolder folder;
  Workcell cell =
      load_with_types(folder, replaced(kSimulatedCell, "FLOOR", "0") +
                                  "random_objects: {count: 3, types: [cube], upright_share: 1}\n");
  cell.known_objects[0].name = "cube 2";
  place_random_objects(cell);
  REQUIRE(cell.known_objects.size() == 4);
  for (const PlacedObject& object : cell.known_objects) {
    CHECK(object.T_world_object.translation().z() == doctest::Approx(0.025));
  }
  CHECK(cell.known_objects[1].name == "cube 1");
  CHECK(cell.known_objects[2].name == "cube 3");  // the name is taken
}

TEST_CASE("random objects without room, or without anything to place") {
  TemporaryFolder folder;
  Workcell full = with_board(folder, "random_objects: {count: 60, types: [cube]}\n");
  expect_bad_input(": random_objects, area", "of 60 bodies were placed",
                   [&] { place_random_objects(full); });
  Workcell none = with_board(folder);
  place_random_objects(none);
  CHECK(none.known_objects.size() == 1);
  none.random_objects = RandomObjects{.count = 1};
  expect_bad_input("random_objects", "no types", [&] { place_random_objects(none); });
  Workcell aside = load_with_types(folder,
                                   "work_area: {min_m: [1, 1, 0], max_m: [2, 2, 1]}\n"
                                   "knowledge_base: types.yaml\n"
                                   "random_objects: {count: 1, types: [cube]}\n" +
                                       replaced(kBoard, "AT", "0"));
  expect_bad_input("above the board", "min < max", [&] { place_random_objects(aside); });
}

}  // namespace vantage::test
