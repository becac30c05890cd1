#include "evaluate/reconstruction/evaluation_truth.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <numbers>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage {
namespace {

using nlohmann::json;

constexpr Intrinsics kCamera{640, 480, 600, 600, 320, 240};

TypePtr model(int id) {
  ObjectType type{"obj_00000" + std::to_string(id)};
  type.mesh = std::make_shared<const TriangleMesh>(box_solid({0.05, 0.05, 0.05}));
  type.bop_id = id;
  return std::make_shared<const ObjectType>(type);
}

Workcell workcell() {
  Workcell cell{.work_area = Box({-1, -1, 0}, {1, 1, 1})};
  cell.knowledge =
      std::make_shared<const MemoryKnowledgeBase>(std::vector<ObjectType>{*model(1), *model(7)});
  return cell;
}

/// Two cameras that look at the origin.
BopScene scene_in(const std::filesystem::path& folder) {
  BopScene scene{folder, {}, {}};
  for (const Eigen::Vector3d& eye : {Eigen::Vector3d(0, -0.5, 0.5), {0.4, 0.4, 0.6}}) {
    scene.images.push_back({.id = int(scene.images.size()),
                            .place = "image",
                            .intrinsics = kCamera,
                            .range = {},
                            .T_world_cam = Pose::looking_at(eye, {0, 0, 0}),
                            .depth = nullptr,
                            .color = {}});
  }
  return scene;
}

json entry(int id, const Pose& T_world_object, const BopImage& image) {
  const Pose pose = image.T_world_cam->inverse() * T_world_object;
  json r = json::array(), t = json::array();
  for (int i = 0; i < 9; ++i) r.push_back(pose.rotation()(i / 3, i % 3));
  for (int i = 0; i < 3; ++i) t.push_back(1000 * pose.translation()[i]);
  return {{"obj_id", id}, {"cam_R_m2c", r}, {"cam_t_m2c", t}};
}

std::vector<TrueObject> read(const test::TemporaryFolder& folder, const json& scene_gt) {
  folder.write("scene_gt.json", scene_gt.dump());
  std::vector<std::filesystem::path> files;
  auto objects = true_objects(workcell(), scene_in(folder.path()), files);
  CHECK(files.size() == 1);
  return objects;
}

Pose turned(double x, double angle = 0) {
  const Eigen::AngleAxisd turn(angle, Eigen::Vector3d::UnitZ());
  return Pose::from_rotation(turn.toRotationMatrix(), {x, 0, 0.025});
}

}  // namespace

TEST_CASE("objects that several images name are one, if their poses agree") {
  const test::TemporaryFolder folder;
  const BopScene scene = scene_in(folder.path());
  const BopImage &a = scene.images[0], &b = scene.images[1];
  const auto objects =
      read(folder, {{"0", {entry(7, turned(-0.2), a), entry(7, turned(0.2, 0.5), a)}},
                    {"1", {entry(7, turned(0.202, 0.5), b), entry(1, turned(-0.2), b)}}});
  REQUIRE(objects.size() == 3);
  CHECK(objects[0].name == "obj_000007 1");
  CHECK(objects[1].name == "obj_000007 2");
  CHECK(objects[2].type->name == "obj_000001");
  CHECK((objects[1].T_world_object.translation() - Eigen::Vector3d(0.2, 0, 0.025)).norm() < 1e-9);
  CHECK(objects[1].T_world_object.quaternion().angularDistance(turned(0, 0.5).quaternion()) < 1e-9);
}

TEST_CASE(
    "a cell's known objects are the truth before the dataset's, and those without a type are not") {
  const test::TemporaryFolder folder;
  const BopScene scene = scene_in(folder.path());
  folder.write("scene_gt.json",
               json({{"0", json::array({entry(7, turned(0), scene.images[0])})}}).dump());
  Workcell cell = workcell();
  const TypePtr type = cell.knowledge->types()[0];
  cell.known_objects.push_back({.name = "a", .mesh = type->mesh, .type = type});
  cell.known_objects.push_back({.name = "b", .mesh = type->mesh});
  std::vector<std::filesystem::path> files;
  const auto objects = true_objects(cell, scene, files);
  REQUIRE(objects.size() == 1);
  CHECK(objects[0].name == "a");
  CHECK(files.empty());
}

TEST_CASE("a truth that cannot be read is refused with the place") {
  const test::TemporaryFolder folder;
  const BopImage image = scene_in(folder.path()).images[0];
  const json good = entry(7, turned(0), image);
  const auto refused = [&](const char* key, const json& value, std::string_view where,
                           std::string_view message) {
    json bad = good;
    bad[key] = value;
    test::expect_bad_input(where, message, [&] { read(folder, {{"0", json::array({bad})}}); });
  };
  refused("obj_id", 3, "scene_gt.json", "the knowledge base has no BOP model 3");
  refused("obj_id", "7", "obj_id", "expected a whole number");
  refused("cam_t_m2c", {1, 2}, "cam_t_m2c", "3");
  refused("cam_R_m2c", {2, 0, 0, 0, 2, 0, 0, 0, 2}, "scene_gt.json", "rotation");
  json lacking = good;
  lacking.erase("cam_t_m2c");
  test::expect_bad_input("cam_t_m2c", "missing; expected an array of 3 numbers", [&] {
    read(folder, {{"0", json::array({lacking})}});
  });
}

TEST_CASE("without any truth there is nothing to evaluate") {
  const test::TemporaryFolder folder;
  std::vector<std::filesystem::path> files;
  test::expect_bad_input(folder.path().string(), "there is no ground truth",
                         [&] { true_objects(workcell(), scene_in(folder.path()), files); });
}

}  // namespace vantage
