// What a workcell file says of the simulated cell.
#include <doctest/doctest.h>

#include <numbers>
#include <string>

#include "apps/cell_files.hpp"
#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "workcell/workcell.hpp"

namespace vantage::test {
namespace {

constexpr std::string_view kTypes =
    "object_types:\n"
    "  - name: cube\n"
    "    shape: {box: {size_m: [0.05, 0.05, 0.05]}}\n"
    "    features: [{type: aruco, dictionary: 4X4_50, value: 3, size_m: 0.03, face: -y}]\n"
    "  - {name: ball, shape: {sphere: {radius_m: 0.03}}}\n";
constexpr std::string_view kBase = "knowledge_base: types.yaml\n";

/// Line 1 is the work area, `text` follows.
Workcell load_scene(const TemporaryFolder& folder, const std::string& text) {
  folder.write("types.yaml", kTypes);
  return load_workcell(folder.write("cell.yaml", kAreaLine + text));
}

void expect_scene_refused(const std::string& text, std::string_view where,
                          std::initializer_list<std::string_view> parts) {
  CAPTURE(text);
  TemporaryFolder folder;
  expect_refused([&] { load_scene(folder, text); }, where, parts);
}

std::string board(const std::string& markers) {
  return "board:\n  size_m: [0.5, 0.3]\n  dictionary: 4X4_50\n  markers: [" + markers + "]\n";
}

}  // namespace

TEST_CASE("objects of a type share its mesh, and the planner gets it") {
  TemporaryFolder folder;
  const Workcell cell =
      load_scene(folder, std::string(kBase) +
                             "known_objects:\n"
                             "  - {name: a, type: cube}\n"
                             "  - {name: b, type: cube, pose: {translation_m: [1, 2, 3]}}\n"
                             "static_structures: [{name: c, type: ball}]\n"
                             "foreign_objects: [{name: d, type: cube}]\n");
  REQUIRE(cell.known_objects.size() == 2);
  CHECK(cell.known_objects[0].type == cell.knowledge->find("cube"));
  CHECK(cell.known_objects[0].mesh == cell.known_objects[1].mesh);
  CHECK(cell.known_objects[0].mesh == cell.known_objects[0].type->mesh);
  CHECK(cell.static_structures[0].type->name == "ball");
  CHECK(cell.foreign_objects[0].type->name == "cube");
  const std::vector<KnownObject> objects = known(cell.known_objects);
  REQUIRE(objects.size() == 2);
  CHECK(objects[1].name == "b");
  CHECK(objects[1].mesh == cell.known_objects[1].mesh);
  CHECK(objects[1].type == "cube");
  CHECK(objects[1].T_world_object.translation() == Eigen::Vector3d(1, 2, 3));
  CHECK(cell.files == std::vector{folder / "cell.yaml", folder / "types.yaml"});
}

TEST_CASE("a known object's markers are where its pose puts them") {
  const Workcell cell = load_workcell(shipped_workcell("wall"));
  const auto red = std::find_if(cell.known_objects.begin(), cell.known_objects.end(),
                                [](const PlacedObject& object) { return object.name == "red"; });
  REQUIRE(red != cell.known_objects.end());
  const std::vector<Marker> markers = red->type->markers();
  const auto front = std::find_if(markers.begin(), markers.end(),
                                  [](const Marker& marker) { return marker.id == 13; });
  REQUIRE(front != markers.end());
  const auto corners = front->corners();  // from the upper left, clockwise
  const double y = 0.06 - 0.025, h = front->size_m / 2;
  const Eigen::Vector3d expected[] = {
      {-h, y, 0.025 + h}, {h, y, 0.025 + h}, {h, y, 0.025 - h}, {-h, y, 0.025 - h}};
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK((red->T_world_object * corners[i] - expected[i]).norm() < 1e-9);
  }
}

TEST_CASE("a knowledge base of several files, and one that is named twice counts once") {
  TemporaryFolder folder;
  folder.write("more.yaml", "object_types: [{name: b, shape: {sphere: {radius_m: 1}}}]\n");
  const Workcell cell = load_scene(folder, "knowledge_base: [types.yaml, more.yaml, types.yaml]\n");
  CHECK(cell.knowledge->types().size() == 3);
  CHECK(cell.files ==
        std::vector{folder / "cell.yaml", folder / "types.yaml", folder / "more.yaml"});
}

TEST_CASE("shapes and colours of objects without a type") {
  TemporaryFolder folder;
  const Workcell cell =
      load_scene(folder,
                 "foreign_objects:\n"
                 "  - {name: a, shape: {sphere: {radius_m: 1}}, color: [1, 0, 0.5]}\n"
                 "  - {name: b, box: {min_m: [0, 0, 0], max_m: [1, 1, 1]}}\n");
  REQUIRE(cell.foreign_objects.size() == 2);
  CHECK(cell.foreign_objects[0].type == nullptr);
  CHECK(cell.foreign_objects[0].color == Eigen::Vector3f(1, 0, 0.5f));
  CHECK(cell.foreign_objects[0].mesh->triangles().size() > 12);
  CHECK(cell.foreign_objects[1].color == TexturedMesh().color);
}

TEST_CASE("objects that contradict themselves or others are refused") {
  const std::string base(kBase);
  expect_scene_refused("known_objects: [{name: a, type: cube}]\n",
                       "cell.yaml:2: known_objects[0].type", {"no knowledge base"});
  expect_scene_refused(base + "known_objects: [{name: a, type: cubes}]\n",
                       "cell.yaml:3: known_objects[0].type", {"did you mean \"cube\"?"});
  expect_scene_refused(base + "known_objects: [{name: a, type: cube, color: [1, 1, 1]}]\n",
                       "cell.yaml:3: known_objects[0].color", {"in the knowledge base"});
  expect_scene_refused(base + "known_objects: [{name: a, type: cube, unit_m: 1}]\n",
                       "cell.yaml:3: known_objects[0].unit_m", {"only a mesh"});
  expect_scene_refused("foreign_objects: [{name: a, shape: {sphere: {radius_m: 0}}}]\n",
                       "foreign_objects[0].shape.sphere.radius_m", {"found 0"});
  expect_scene_refused(
      base + "known_objects: [{name: a, type: cube}]\nforeign_objects: [{name: a, type: cube}]\n",
      "cell.yaml:4: foreign_objects[0].name", {"known_objects[0].name"});
  expect_scene_refused("knowledge_base: gone.yaml\n", "cell.yaml:2: knowledge_base",
                       {"no file", "gone.yaml"});
  expect_scene_refused("knowledge_base: [types.yaml, gone.yaml]\n", "knowledge_base[1]",
                       {"no file"});
  expect_scene_refused("knowledge_base: []\n", "knowledge_base", {"found []"});
}

TEST_CASE("a board's markers lie on z = 0 and turn around z") {
  TemporaryFolder folder;
  const Workcell cell =
      load_scene(folder, board("{id: 7, size_m: 0.04, at_m: [0.2, -0.1]},"
                               "{id: 8, size_m: 0.05, at_m: [0, 0.1], turn: 1.5707963267948966}"));
  REQUIRE(cell.board);
  CHECK(cell.board->size_m == Eigen::Vector2d(0.5, 0.3));
  CHECK(cell.board->thickness_m == 0.01);
  REQUIRE(cell.board->markers.size() == 2);
  CHECK(cell.board->markers[0].dictionary == "4X4_50");
  CHECK(cell.board->markers[0].id == 7);
  const auto upright = cell.board->markers[0].corners();
  CHECK((upright[0] - Eigen::Vector3d(0.18, -0.08, 0)).norm() < 1e-12);
  CHECK((upright[2] - Eigen::Vector3d(0.22, -0.12, 0)).norm() < 1e-12);
  const auto turned = cell.board->markers[1].corners();
  CHECK((turned[0] - Eigen::Vector3d(-0.025, 0.075, 0)).norm() < 1e-12);

  const std::vector<ObjectFeature> features = cell.board->features();
  REQUIRE(features.size() == 2);
  CHECK(features[1].key == FeatureKey{"aruco", "4X4/8"});
  CHECK(features[1].points()[0] == turned[0]);
}

TEST_CASE("a board may be a file of its own") {
  TemporaryFolder folder;
  folder.write("board.yaml", "size_m: [1, 1]\ndictionary: 4X4_50\nmarkers: []\ncolor: [0, 1, 0]\n");
  const Workcell cell = load_scene(folder, "board: board.yaml\n");
  REQUIRE(cell.board);
  CHECK(cell.board->color == Eigen::Vector3f(0, 1, 0));
  CHECK(cell.files == std::vector{folder / "cell.yaml", folder / "board.yaml"});
  expect_refused([&] { load_scene(folder, "board: gone.yaml\n"); }, "cell.yaml:2: board",
                 {"no file"});
  folder.write("board.yaml", "size_m: [1, 1]\ndictionary: 4X4_50\nmarker: []\n");
  expect_refused([&] { load_scene(folder, "board: board.yaml\n"); }, "board.yaml:3: marker",
                 {"unknown key", "\"markers\""});
  folder.write("board.yaml", "other.yaml\n");
  expect_refused([&] { load_scene(folder, "board: board.yaml\n"); }, "board.yaml:1",
                 {"a board's keys"});
}

TEST_CASE("markers that a board cannot have are refused") {
  expect_scene_refused(board("{id: 50, size_m: 0.04, at_m: [0, 0]}"),
                       "cell.yaml:5: board.markers[0].id", {"50"});
  expect_scene_refused(
      "board: {size_m: [1, 1], dictionary: 4X4, markers: []}\n"
      "voxel_size_m: 0\n",
      "cell.yaml:3: voxel_size_m", {"found 0"});
  expect_scene_refused(
      "board: {size_m: [1, 1], dictionary: 4X4,\n"
      "  markers: [{id: 0, size_m: 0.1, at_m: [0, 0]}]}\n",
      "cell.yaml:2: board.dictionary", {"4X4", "4X4_50"});
  expect_scene_refused(board("{id: 7, size_m: 0.04, at_m: [0, 0]},"
                             "{id: 7, size_m: 0.04, at_m: [0.1, 0]}"),
                       "cell.yaml:5: board.markers[1].id", {"marker 7", "board.markers[0]"});
  // The cube has it.
  expect_scene_refused(std::string(kBase) + board("{id: 3, size_m: 0.04, at_m: [0, 0]}"),
                       "cell.yaml:6: board.markers[0].id", {"marker 3", "the type cube"});
}

TEST_CASE("cameras have a pose or look at something") {
  TemporaryFolder folder;
  const Workcell cell =
      load_scene(folder,
                 "sensor: {depth_range_m: [0.2, 4]}\n"
                 "cameras:\n"
                 "  - {name: a, eye_m: [0, -1, 0], target_m: [0, 0, 0]}\n"
                 "  - name: b\n"
                 "    pose: {translation_m: [1, 2, 3]}\n"
                 "    intrinsics: {width: 8, height: 6, fx: 5, fy: 5, cx: 4, cy: 3}\n");
  REQUIRE(cell.cameras.size() == 2);
  CHECK(cell.cameras[0].name == "a");
  const PinholeCamera& a = cell.cameras[0].camera;
  CHECK(a.intrinsics() == Intrinsics{640, 480, 615, 615, 319.5, 239.5});
  CHECK(a.range() == DepthRange{0.2, 4});
  const auto above = a.project({0, 0, 0.1});
  REQUIRE(above);
  CHECK(above->u == doctest::Approx(319.5));
  CHECK(above->v == doctest::Approx(239.5 - 61.5));
  CHECK(above->depth == doctest::Approx(1));
  CHECK(cell.cameras[1].camera.intrinsics() == Intrinsics{8, 6, 5, 5, 4, 3});
  CHECK(cell.cameras[1].camera.centre() == Eigen::Vector3d(1, 2, 3));
  const Workcell wide =
      load_scene(folder,
                 "sensor: {intrinsics: {width: 8, height: 6, fx: 5, fy: 5, cx: 4, cy: 3}}\n"
                 "cameras: [{name: a, pose: {}}]\n");
  CHECK(wide.cameras[0].camera.intrinsics() == Intrinsics{8, 6, 5, 5, 4, 3});
  CHECK(wide.cameras[0].camera.range() == DepthRange{});
}

TEST_CASE("cameras that look nowhere are refused") {
  const auto with = [](const std::string& camera) { return "cameras: [" + camera + "]\n"; };
  expect_scene_refused(with("{name: a}"), "cell.yaml:2: cameras[0]",
                       {"exactly one of the keys \"pose\", \"eye_m\" with \"target_m\""});
  expect_scene_refused(with("{name: a, eye_m: [0, 0, 0]}"), "cameras[0]", {"exactly one"});
  expect_scene_refused(with("{name: a, pose: {}, target_m: [0, 0, 0]}"), "cameras[0]",
                       {"exactly one"});
  expect_scene_refused(with("{name: a, eye_m: [1, 0, 0], target_m: [1, 0, 0]}"),
                       "cell.yaml:2: cameras[0].target_m", {"coincides"});
  expect_scene_refused(with("{name: a, pose: {}}, {name: a, pose: {}}"),
                       "cell.yaml:2: cameras[1].name", {"\"a\"", "cameras[0].name"});
  expect_scene_refused(with("{name: a, pose: {}, intrinsics: {width: 8, height: 6, fx: 5, fy: 5,"
                            " cx: 4}}"),
                       "cameras[0].intrinsics.cy", {"missing"});
}

TEST_CASE("random objects are read, and checked against the knowledge base") {
  TemporaryFolder folder;
  const Workcell cell = load_scene(
      folder, std::string(kBase) +
                  "random_objects: {count: 3, types: [ball, cube], seed: 9223372036854775807,"
                  " upright_share: 0.25}\n");
  REQUIRE(cell.random_objects);
  CHECK(cell.random_objects->count == 3);
  REQUIRE(cell.random_objects->types.size() == 2);
  CHECK(cell.random_objects->types[0]->name == "ball");
  CHECK(cell.random_objects->seed == 9223372036854775807u);
  CHECK(cell.random_objects->upright_share == 0.25);
  CHECK(cell.known_objects.empty());  // `place_random_objects` adds them
  const std::string base(kBase);
  expect_scene_refused(base + "random_objects: {count: 3, types: [bal]}\n",
                       "cell.yaml:3: random_objects.types[0]", {"did you mean \"ball\"?"});
  expect_scene_refused(base + "random_objects: {count: -1, types: [ball]}\n",
                       "random_objects.count", {"found -1"});
  expect_scene_refused(base + "random_objects: {count: 3, types: []}\n", "random_objects.types",
                       {"found []"});
  expect_scene_refused(base + "random_objects: {count: 3, types: [ball], upright_share: 2}\n",
                       "random_objects.upright_share", {"found 2"});
  expect_scene_refused(base + "random_objects: {count: 3, types: [ball], seed: -1}\n",
                       "random_objects.seed", {"found -1"});
}

}  // namespace vantage::test
