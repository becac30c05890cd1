#include "reconstruct/world_file.hpp"

#include <doctest/doctest.h>

#include "documents/document.hpp"
#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "reconstruct/world_json.hpp"
#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage::test {
namespace {

TypePtr box_type(const char* name) {
  ObjectType type{.name = name};
  type.mesh = std::make_shared<const TriangleMesh>(box_solid({0.1, 0.1, 0.1}));
  type.features.push_back(marker_feature({"4X4_50", 7, 0.03, {}}));
  return std::make_shared<const ObjectType>(type);
}

std::shared_ptr<const FileKnowledgeBase> knowledge_in(const TemporaryFolder& folder) {
  const auto file = folder.write("types.yaml",
                                 "object_types:\n"
                                 "  - name: cube\n"
                                 "    shape: {box: {size_m: [0.1, 0.1, 0.1]}}\n"
                                 "    features: [{type: aruco, dictionary: 4X4_50, value: 7, "
                                 "size_m: 0.03, face: +z}]\n"
                                 "  - {name: ball, shape: {sphere: {radius_m: 0.05}}}\n");
  return std::make_shared<const FileKnowledgeBase>(std::vector{file});
}

const Pose kCamera = Pose::looking_at({0.5, 0.4, 0.3}, {0, 0, 0});
const Pose kThere = Pose::from_quaternion(Eigen::Quaterniond(0.8, 0, 0.6, 0), {0.1, 0.2, 0.3});

/// Two cameras, of which one was not located, and two cubes, of which one may be a ball.
struct Case {
  TemporaryFolder folder;
  Workcell workcell{.work_area = Box({0, 0, 0}, {1, 1, 1})};
  BopScene scene;
  SceneReconstruction made;

  Case() {
    workcell.knowledge = knowledge_in(folder);
    const Intrinsics k{640, 480, 600, 600, 319.5, 239.5};
    for (int id : {3, 20}) {
      scene.images.push_back({id, "entry", k, {}, {}, nullptr, {}});
      made.observed.views.push_back({std::to_string(id), Lens(k, {0.1})});
      made.observed.locations.emplace_back();
      made.observed.board.emplace_back();
    }
    CameraView& view = made.observed.views[0];
    view.T_world_cam = kCamera;
    view.observations.push_back({marker_key("4X4_50", 7), SeenPoints{}});
    view.observations.push_back({marker_key("4X4_50", 9), SeenPoints{}});
    made.observed.locations[0].pose = LocatedPose{kCamera, Matrix6d::Identity() * 1e-6, 0.2, 3};
    made.observed.locations[0].inliers = {0, 1, 2};
    made.observed.locations[1].reason = "no marker of the board is seen";
    const TypePtr cube = workcell.knowledge->types()[0], ball = workcell.knowledge->types()[1];
    ReconstructedObject object{cube,
                               kThere,
                               Matrix6d(Matrix6d::Identity() * 1e-8),
                               0.75,
                               0.1,
                               {{{0, 0}, 0, 0.1}},
                               {{ball, kCamera, 0.25}}};
    made.result.objects = {object, object};
    made.result.objects[1].covariance.reset();
    made.result.objects[1].alternatives.clear();
    made.result.unexplained.push_back({{0, 1}, "no type has this feature"});
  }

  nlohmann::ordered_json json() const {
    return world_to_json(scene, workcell, made, known_objects(made.result),
                         {{}, {{"method", "pnp"}}, {"odd"}, 0.1, 0.2});
  }
};

}  // namespace

TEST_CASE("a world that was written is read back") {
  const Case c;
  const auto json = c.json();
  CHECK_NOTHROW(check_schema(Document{"world.json", json}, world_schema()));
  const WorldFile world =
      read_world(c.folder.write("world.json", json.dump()), *c.workcell.knowledge);
  REQUIRE(world.T_world_cam.size() == 2);
  REQUIRE(world.T_world_cam.at(3));
  CHECK((world.T_world_cam.at(3)->translation() - kCamera.translation()).norm() < 1e-12);
  CHECK(!world.T_world_cam.at(20));
  REQUIRE(world.objects.size() == 2);
  CHECK(world.objects[0].name == "cube 1");
  CHECK(world.objects[1].name == "cube 2");
  CHECK(world.objects[0].type == "cube");
  CHECK(world.objects[0].mesh == c.workcell.knowledge->types()[0]->mesh);
  CHECK((world.objects[0].T_world_object.rotation() - kThere.rotation()).norm() < 1e-12);
  CHECK(world.objects[0].probability == 0.75);
  REQUIRE(world.objects[0].covariance);
  CHECK((*world.objects[0].covariance - Matrix6d::Identity() * 1e-8).norm() == 0);
  CHECK(!world.objects[1].covariance);
  REQUIRE(world.objects[0].alternatives.size() == 1);
  CHECK(world.objects[0].alternatives[0].type == "ball");
  CHECK(world.objects[0].alternatives[0].probability == 0.25);
}

TEST_CASE("a world has BOP's poses beside ours, and says what is left over") {
  const auto json = Case().json();
  REQUIRE(json["bop"].contains("3"));
  CHECK(!json["bop"].contains("20"));  // nobody knows where that camera is
  const auto& entry = json["bop"]["3"][0];
  CHECK(entry["obj_id"] == 1);
  const Eigen::Vector3d expected = 1000 * (kCamera.inverse() * kThere).translation();
  for (int i = 0; i < 3; ++i) {
    CHECK(std::abs(entry["cam_t_m2c"][std::size_t(i)].get<double>() - expected[i]) < 1e-9);
  }
  CHECK(json["cameras"][1]["reason"] == "no marker of the board is seen");
  CHECK(json["cameras"][0]["distortion"][0] == 0.1);
  CHECK(json["unexplained"][0]["value"] == "4X4/9");
  const std::string text = summary_of_world(json);
  for (const char* part : {"cube 1", "or ball", "not located: no marker", "no type has this"}) {
    CAPTURE(part);
    CHECK(text.find(part) != std::string::npos);
  }
}

TEST_CASE("a world.json that is damaged is refused with the place") {
  const Case c;
  const auto refused = [&](auto change, const char* where, const char* message) {
    CAPTURE(where);
    auto json = c.json();
    change(json);
    const auto file = c.folder.write("world.json", json.dump(1));
    expect_bad_input(where, message, [&] { read_world(file, *c.workcell.knowledge); });
  };
  refused([](auto& w) { w["objects"][1]["type"] = "cub"; }, "objects[1].type", "\"cube\"");
  refused([](auto& w) { w["objects"][0]["name"] = "cube 2"; }, "objects[1].name", "twice");
  refused([](auto& w) { w["cameras"][1]["image"] = 3; }, "cameras[1].image", "twice");
  refused([](auto& w) { w["objects"][0]["covariance"][0][3] = 1; }, "covariance", "symmetric");
  refused([](auto& w) { w["objects"][0]["covariance"][2][2] = -1e-8; }, "covariance", "variance");
  refused([](auto& w) { w["objects"][0]["T_world_object"]["rotation"]["w"] = 2; }, "rotation",
          "norm");
  refused([](auto& w) { w["objects"][0].erase("T_world_object"); }, "objects[0].T_world_object",
          "missing");
  refused([](auto& w) { w["object"] = 1; }, "object", "objects");
}

TEST_CASE("names of objects are unique, whatever else is there") {
  Reconstruction result;
  const TypePtr cube = box_type("cube"), ball = box_type("ball");
  for (const TypePtr& type : {ball, cube, cube}) result.objects.push_back({type, {}});
  const auto objects = known_objects(result, {"ball", "cube 1"});
  REQUIRE(objects.size() == 3);
  CHECK(objects[0].name == "ball 1");
  CHECK(objects[1].name == "cube 2");
  CHECK(objects[2].name == "cube 3");
}

}  // namespace vantage::test
