#include "plan/plan_input.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "reconstruction/scene_folder.hpp"

namespace vantage::test {
namespace {

constexpr std::string_view kInputCell =
    "work_area: {min_m: [-1, -1, 0], max_m: [1, 1, 0.5]}\n"
    "knowledge_base: types.yaml\n"
    "known_objects: [{name: a, type: cube, pose: {translation_m: [0.1, 0.2, 0.3]}}]\n"
    "static_structures: [{name: b, type: cube}, {name: c, shape: {sphere: {radius_m: 0.1}}}]\n"
    "foreign_objects: [{name: d, type: cube, pose: {translation_m: [0.5, 0, 0]}}]\n"
    "board: {size_m: [1, 1], dictionary: 4X4_50, markers: []}\n"
    "cameras: [{name: e, eye_m: [0, 0, 1], target_m: [0, 0, 0]}]\n"
    "random_objects: {count: 2, types: [cube]}\n";

}  // namespace

TEST_CASE("the planner gets objects of types with their meshes, and nothing of the simulator's") {
  SceneFolder scene;
  scene.good_entry().depth().color();
  TemporaryFolder folder;
  folder.write("types.yaml",
               "object_types: [{name: cube, shape: {box: {size_m: [0.1, 0.2, 0.4]}}}]\n");
  PlanOptions options;
  options.dataset = scene.path();
  options.workcell = folder.write("cell.yaml", kInputCell);
  const PlanInput input = load_plan_input(options);

  REQUIRE(input.world.objects.size() == 1);  // those at random have to be found
  const KnownObject& cube = input.world.objects[0];
  CHECK(cube.name == "a");
  CHECK(cube.T_world_object.translation() == Eigen::Vector3d(0.1, 0.2, 0.3));
  Eigen::AlignedBox3f bounds;
  for (const Eigen::Vector3f& vertex : cube.mesh->vertices()) bounds.extend(vertex);
  CHECK(bounds.max() == Eigen::Vector3f(0.05f, 0.1f, 0.2f));
  REQUIRE(input.world.static_structures.size() == 2);
  CHECK(input.world.static_structures[0].mesh == cube.mesh);
  CHECK(input.world.cameras.size() == 1);  // the dataset's
  CHECK(input.world.cameras[0].name == "7");
  CHECK(input.record.inputs[1] == folder / "types.yaml");
}

TEST_CASE("the planner gets the workcell's candidates and limits, the command line's first") {
  SceneFolder scene;
  scene.good_entry().depth().color();
  TemporaryFolder folder;
  PlanOptions options;
  options.dataset = scene.path();
  options.workcell = folder.write("cell.yaml",
                                  "work_area: {min_m: [-1, -1, 0], max_m: [1, 1, 0.5]}\n"
                                  "known_objects: []\n"
                                  "candidates: {radii_m: [0.5], count: 9}\n"
                                  "reach: {base_m: [0, 0, 0], max_m: 2}\n"
                                  "clearance_m: 0.05\n");
  options.objects.objects = "given";
  const PlanRequest request = load_plan_input(options).request;
  CHECK(std::get<HalfSpheres>(request.candidates).counts == std::vector{9});
  CHECK(request.constraints.reach->max_m == 2);
  CHECK(request.constraints.clearance_m == 0.05);

  const auto views = folder.write("v.yaml", "views: [{eye_m: [1, 0, 1], target_m: [0, 0, 0]}]\n");
  options.candidates.set = views.string();
  options.candidates.given["clearance_m"] = 0.01;
  const PlanInput changed = load_plan_input(options);
  CHECK(std::get<ViewList>(changed.request.candidates).poses.size() == 1);
  CHECK(changed.request.constraints.clearance_m == 0.01);
  CHECK(std::ranges::count(changed.record.inputs, views) == 1);
}

TEST_CASE("a workcell says how to plan, and the command line overrides it field by field") {
  SceneFolder scene;
  scene.good_entry().depth().color();
  TemporaryFolder folder;
  PlanOptions options;
  options.dataset = scene.path();
  options.objects.objects = "given";
  options.workcell = folder.write("cell.yaml",
                                  "work_area: {min_m: [-1, -1, 0], max_m: [1, 1, 0.5]}\n"
                                  "known_objects: []\n"
                                  "voxel_size_m: 0.02\n"
                                  "volume: {band_sigmas: 3, noise: {baseline_m: 0.1}}\n"
                                  "plan:\n"
                                  "  method: mesh\n"
                                  "  mesh: {opening_m: 0.01, weight: depth}\n"
                                  "  servo: {iterations: 2}\n"
                                  "  views: {most: 3}\n");
  options.given = {{"servo", {{"image_width", 80}}}, {"volume", {{"band_sigmas", 5}}}};
  const PlanRequest request = load_plan_input(options).request;
  CHECK(request.method == Method(MeshMethod{.opening_m = 0.01, .weight = MeshWeight::depth}));
  CHECK(request.servo.iterations == 2);
  CHECK(request.servo.image_width == 80);
  CHECK(request.views.most == 3);
  CHECK(request.voxel_size_m == 0.02);
  CHECK(request.volume.band_sigmas == 5);
  CHECK(request.volume.noise.baseline_m == 0.1);

  options.workcell = folder.write("wrong.yaml",
                                  "work_area: {min_m: [-1, -1, 0], max_m: [1, 1, 0.5]}\n"
                                  "plan: {servo: {iteration: 2}}\n");
  expect_bad_input("wrong.yaml:2", "iterations", [&] { load_plan_input(options); });
}

}  // namespace vantage::test
