#include "vantage/reconstruction/check_scene.hpp"

#include <doctest/doctest.h>

#include "reconstruction/synthetic_views.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage::test {
namespace {

KnownObject table() {
  return {"the table", std::make_shared<TriangleMesh>(box_solid({0.6, 0.6, 0.02})),
          Pose::from_translation({0, 0, -0.01})};
}

TypePtr cube() {
  return std::make_shared<ObjectType>(marked_box("cube", {0.08, 0.08, 0.08}, 0));
}

/// The same type as the knowledge base has it, with its markers in another size.
ObjectType with_marker_size(ObjectType type, double factor) {
  for (ObjectFeature& feature : type.features) {
    std::get<Marker>(feature.geometry).size_m *= factor;
  }
  return type;
}

bool mentions(const std::string& text, const char* words) {
  return text.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("objects on a table stay, and none is thrown out by what is right") {
  Random random(2);
  for (std::uint32_t scene = 0; scene < scene_count(15); ++scene) {
    CAPTURE(scene);
    std::vector<CameraView> views = cameras_around(random, 4);
    const std::vector<TypePtr> types = {cube()};
    std::vector<PlacedObject> objects = scattered(random, types, 4, 0.25);
    for (PlacedObject& object : objects) {
      const Eigen::Vector3d at = object.T_world_object.translation();
      const double turn = random.uniform(0, 6);
      object.T_world_object = Pose::from_rotation(
          Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).matrix(), {at.x(), at.y(), 0.04});
    }
    look_at(views, objects, {.sigma_px = 0.1}, random);
    const MemoryKnowledgeBase knowledge({*types[0]});
    Reconstruction result = reconstruct_pnp(views, knowledge);
    const std::size_t before = result.objects.size();
    SceneKnowledge scene_knowledge;
    scene_knowledge.solids = {table()};
    reject_contradicted(views, scene_knowledge, result);
    warn_of_motion(views, knowledge, {}, {}, result);
    CHECK(result.objects.size() == before);
    for (const ReconstructedObject& object : result.objects) CHECK(object.warning.empty());
  }
}

TEST_CASE(
    "markers of another size than stated: their objects are below the table, and the size is "
    "named") {
  Random random(3);
  std::uint32_t named = 0, kept = 0;
  const std::uint32_t scenes = scene_count(15);
  for (std::uint32_t scene = 0; scene < scenes; ++scene) {
    CAPTURE(scene);
    std::vector<CameraView> views = cameras_around(random, 3);
    const TypePtr true_type = cube();
    look_at(views, {{true_type, Pose::from_translation({0.03, 0.02, 0.04})}}, {.sigma_px = 0.05},
            random);
    const MemoryKnowledgeBase knowledge({with_marker_size(*true_type, 1.25)});
    Reconstruction result = reconstruct_pnp(views, knowledge);
    SceneKnowledge scene_knowledge;
    scene_knowledge.solids = {table()};
    reject_contradicted(views, scene_knowledge, result);
    kept += std::uint32_t(result.objects.size());
    bool has_size = false;
    for (const Unexplained& left : result.unexplained) {
      has_size = has_size || mentions(left.reason, "0.8");
    }
    named += has_size;
  }
  MESSAGE("named in ", named, " of ", scenes, "; ", kept, " objects kept");
  CHECK(named >= enough(12));
  CHECK(kept <= 1);
}

TEST_CASE("an object that moved between two pictures causes a warning that names the picture") {
  Random random(4);
  std::uint32_t warned = 0, right_image = 0;
  const std::uint32_t scenes = scene_count(15);
  for (std::uint32_t scene = 0; scene < scenes; ++scene) {
    CAPTURE(scene);
    std::vector<CameraView> views = cameras_around(random, 4);
    const TypePtr type = cube();
    const Pose before = Pose::from_translation({0.0, 0.0, 0.04});
    const Pose after = Pose::from_translation({0.003, 0.002, 0}) * before;
    std::vector<CameraView> first(views.begin(), views.begin() + 3);
    std::vector<CameraView> last(views.begin() + 3, views.end());
    look_at(first, {{type, before}}, {.sigma_px = 0.05}, random);
    look_at(last, {{type, after}}, {.sigma_px = 0.05}, random);
    first.insert(first.end(), last.begin(), last.end());
    const MemoryKnowledgeBase knowledge({*type});
    Reconstruction result = reconstruct_pnp(first, knowledge);
    warn_of_motion(first, knowledge, {}, {}, result);
    for (const ReconstructedObject& object : result.objects) {
      warned += !object.warning.empty();
      right_image += mentions(object.warning, ("image " + first[3].name + " disagrees").c_str());
    }
  }
  MESSAGE("warned in ", warned, " of ", scenes, ", the right image in ", right_image);
  CHECK(warned >= enough(12));
  CHECK(right_image >= enough(10));
}

TEST_CASE("an object that would hide a marker of the board is not reported") {
  Random random(5);
  std::vector<CameraView> views = cameras_around(random, 1);
  const TypePtr type = cube();
  const Eigen::Vector3d& eye = views[0].T_world_cam->translation();
  Reconstruction result;
  ReconstructedObject object{type, Pose::from_translation(0.5 * eye)};
  object.support = {{{0, 0}, 0, 0.1}};
  result.objects = {object};
  views[0].observations = {{type->features[0].key, SeenPoints{{{1, 1}, {2, 1}, {2, 2}, {1, 2}}}}};
  SceneKnowledge knowledge;
  const double s = 0.01;
  knowledge.seen_points = {{{-s, -s, 0}, {s, -s, 0}, {s, s, 0}, {-s, s, 0}}};
  reject_contradicted(views, knowledge, result);
  CHECK(result.objects.empty());
  REQUIRE(result.unexplained.size() == 1);
  CHECK(mentions(result.unexplained[0].reason, "would hide a marker of the board that image"));
}

TEST_CASE("a marker that is larger than its object is refused") {
  ObjectType type = marked_box("small", {0.04, 0.04, 0.04}, 0);
  std::get<Marker>(type.features[2].geometry).size_m = 0.06;
  expect_error(ErrorCode::bad_input, "small.features[2]", "larger than the face that carries it",
               [&] { MemoryKnowledgeBase({type}); });
}

}  // namespace vantage::test
