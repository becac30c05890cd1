// Negative evidence: what speaks against objects that were found.

#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "reconstruction/synthetic_views.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/check_scene.hpp"

namespace vantage::test {
namespace {

TypePtr evident_cube(int first_id = 0, double size_m = 0.08) {
  return std::make_shared<ObjectType>(
      marked_box("cube " + std::to_string(first_id), {size_m, size_m, size_m}, first_id));
}

/// Four cameras around the origin, half a metre up.
std::vector<CameraView> four_cameras() {
  std::vector<CameraView> views;
  for (int i = 0; i < 4; ++i) {
    const double angle = 0.785 + i * 1.5708;
    const Eigen::Vector3d eye(0.5 * std::cos(angle), 0.5 * std::sin(angle), 0.5);
    views.push_back({std::to_string(i), Lens({640, 480, 615, 615, 319.5, 239.5}, {}),
                     Pose::looking_at(eye, {0, 0, 0})});
  }
  return views;
}

/// What ideal depth cameras beside the views measure of these objects, on a table at z = 0.
std::vector<DepthCamera> ideal_depth(const std::vector<CameraView>& views,
                                     const std::vector<PlacedObject>& objects) {
  SceneBuilder builder;
  builder.add_mesh(box_solid({2, 2, 0.02}).transformed(Pose::from_translation({0, 0, -0.01})));
  for (const PlacedObject& object : objects) {
    builder.add_instance(object.type->mesh, object.T_world_object);
  }
  const auto scene = builder.build();
  std::vector<DepthCamera> depth;
  for (const CameraView& view : views) {
    const PinholeCamera camera(view.lens.intrinsics(), *view.T_world_cam);
    depth.push_back({view.name, camera, std::make_shared<DepthImage>(scene->render_depth(camera))});
  }
  return depth;
}

KnownObject slab(const char* name, const Eigen::Vector3d& size_m, const Eigen::Vector3d& centre) {
  return {name, std::make_shared<TriangleMesh>(box_solid(size_m)), Pose::from_translation(centre)};
}

/// Keeps only what view `view` sees of `key`.
void keep_only(std::vector<CameraView>& views, std::size_t view, const FeatureKey& key) {
  for (std::size_t v = 0; v < views.size(); ++v) {
    std::erase_if(views[v].observations,
                  [&](const Observation& seen) { return v != view || seen.key != key; });
  }
}

Reconstruction found_in(const std::vector<CameraView>& views, const std::vector<TypePtr>& types) {
  std::vector<ObjectType> all;
  for (const TypePtr& type : types) all.push_back(*type);
  return reconstruct_pnp(views, MemoryKnowledgeBase(std::move(all)));
}

/// Every camera saw something of this: detectors looked at every picture.
std::vector<std::vector<Eigen::Vector3d>> far_marker(std::size_t views) {
  return std::vector<std::vector<Eigen::Vector3d>>(
      views, {{0.3, 0.3, 0}, {0.32, 0.3, 0}, {0.32, 0.32, 0}, {0.3, 0.32, 0}});
}

const FeatureKey kTopMarker = marker_key("4X4_250", 4);

bool reason_has(const Reconstruction& result, const char* words) {
  return result.rejected.size() == 1 && result.rejected[0].reason.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("an object of which all should be seen, and only one marker is, is not there") {
  Random random(1);
  auto views = four_cameras();
  const TypePtr type = evident_cube();
  look_at(views, {{type, Pose::from_translation({0, 0, 0.04})}}, {.sigma_px = 0.05}, random);
  Reconstruction whole = found_in(views, {type});
  keep_only(views, 0, kTopMarker);
  Reconstruction single{found_in({views[0]}, {type}).objects, {}, StopReason::none};
  REQUIRE(single.objects.size() <= 1);

  reject_contradicted(views, {{}, far_marker(4)}, whole);
  REQUIRE(whole.objects.size() == 1);
  CHECK(whole.objects[0].probability > 0.999);
  REQUIRE(whole.objects[0].evidence);
  CHECK(whole.objects[0].evidence->missing_features > -0.5);

  // The same marker in all views, e.g. on a sheet of paper: the others should have been seen.
  auto sheet = four_cameras();
  look_at(sheet, {{type, Pose::from_translation({0, 0, 0.04})}}, {.sigma_px = 0.05}, random);
  for (CameraView& view : sheet) {
    std::erase_if(view.observations,
                  [](const Observation& seen) { return seen.key != kTopMarker; });
    REQUIRE(view.observations.size() == 1);
  }
  Reconstruction alone = found_in(sheet, {type});
  REQUIRE(alone.objects.size() == 1);
  reject_contradicted(sheet, {}, alone);
  CHECK(alone.objects.empty());
  CHECK(reason_has(alone, "should be seen, but are not"));
  CHECK(alone.unexplained.size() == 4);
  REQUIRE(alone.rejected.size() == 1);
  CHECK(alone.rejected[0].object.evidence->features_missing >= 6);
  CHECK(alone.rejected[0].object.probability < 0.5);
}

TEST_CASE("what a structure hides is not missing") {
  Random random(2);
  auto views = four_cameras();
  const TypePtr type = evident_cube();
  look_at(views, {{type, Pose::from_translation({0, 0, 0.04})}}, {.sigma_px = 0.05}, random);
  for (CameraView& view : views) {
    std::erase_if(view.observations,
                  [](const Observation& seen) { return seen.key != kTopMarker; });
  }
  Reconstruction result = found_in(views, {type});
  REQUIRE(result.objects.size() == 1);
  // A frame around the cube, as high as it is: only its top can be seen.
  SceneKnowledge knowledge;
  knowledge.solids = {slab("left", {0.02, 0.2, 0.078}, {-0.06, 0, 0.039}),
                      slab("right", {0.02, 0.2, 0.078}, {0.06, 0, 0.039}),
                      slab("front", {0.1, 0.02, 0.078}, {0, -0.06, 0.039}),
                      slab("back", {0.1, 0.02, 0.078}, {0, 0.06, 0.039})};
  reject_contradicted(views, knowledge, result);
  REQUIRE(result.objects.size() == 1);
  CHECK(result.objects[0].evidence->missing_features == doctest::Approx(0));
  CHECK(result.objects[0].probability > 0.9);
}

TEST_CASE("depth that sees through an object takes it away, depth that stops before it does not") {
  Random random(3);
  auto views = four_cameras();
  const TypePtr type = evident_cube();
  const PlacedObject cube{type, Pose::from_translation({0, 0, 0.04})};
  look_at(views, {cube}, {.sigma_px = 0.05}, random);
  keep_only(views, 0, kTopMarker);
  Reconstruction single = found_in({views[0]}, {type});
  if (single.objects.empty()) single.objects.push_back(single.rejected.at(0).object);
  single.rejected.clear();
  const EvidenceKinds only_depth{.missing_features = false};

  SceneKnowledge knowledge;
  knowledge.depth = ideal_depth(views, {cube});
  Reconstruction there = single;
  reject_contradicted(views, knowledge, there, only_depth);
  REQUIRE(there.objects.size() == 1);
  CHECK(there.objects[0].evidence->depth > 2);
  CHECK(there.objects[0].evidence->depth_on_surface > 20);

  knowledge.depth = ideal_depth(views, {});
  Reconstruction gone = single;
  reject_contradicted(views, knowledge, gone, only_depth);
  CHECK(gone.objects.empty());
  CHECK(reason_has(gone, "depth images see something else where a cube 0 would be"));
  CHECK(gone.rejected[0].object.evidence->depth_behind > 10);

  // Other cameras, before which something stands: they know nothing of the cube.
  std::vector<CameraView> others(views.begin() + 1, views.end());
  const PlacedObject wall{std::make_shared<ObjectType>(marked_box("wall", {1, 1, 0.3}, 100)),
                          Pose::from_translation({0, 0, 0.15})};
  knowledge.depth = ideal_depth(others, {wall});
  Reconstruction behind = single;
  reject_contradicted(views, knowledge, behind, only_depth);
  REQUIRE(behind.objects.size() == 1);
  CHECK(behind.objects[0].evidence->depth == 0);
  CHECK(behind.objects[0].evidence->depth_in_front > 20);
}

TEST_CASE("a marker that is read as one of another size: depth at its pixels says so") {
  Random random(4);
  auto views = four_cameras();
  const TypePtr small = evident_cube(0, 0.05), large = evident_cube(6, 0.08);
  const PlacedObject cube{small, Pose::from_translation({0, 0, 0.025})};
  look_at(views, {cube}, {.sigma_px = 0.05}, random);
  keep_only(views, 0, marker_key("4X4_250", 4));
  views[0].observations[0].key = marker_key("4X4_250", 10);
  Reconstruction result = found_in({views[0]}, {small, large});
  if (result.objects.empty()) result.objects.push_back(result.rejected.at(0).object);
  result.rejected.clear();
  SceneKnowledge knowledge;
  knowledge.depth = ideal_depth(views, {cube});
  reject_contradicted(views, knowledge, result, {.missing_features = false});
  CHECK(result.objects.empty());
  REQUIRE(result.rejected.size() == 1);
  CHECK(result.rejected[0].object.evidence->depth < -3);
}

TEST_CASE("of two objects in one place the one with more evidence stays, whatever their order is") {
  Random random(5);
  auto views = four_cameras();
  const TypePtr right = evident_cube(0), wrong = evident_cube(6);
  look_at(views, {{right, Pose::from_translation({0, 0, 0.04})}}, {.sigma_px = 0.05}, random);
  Reconstruction result = found_in(views, {right, wrong});
  REQUIRE(result.objects.size() == 1);
  views[1].observations.push_back(views[1].observations.back());
  views[1].observations.back().key = marker_key("4X4_250", 10);
  ReconstructedObject phantom{wrong, Pose::from_translation({0.01, 0.01, 0.045})};
  phantom.support = {{{1, views[1].observations.size() - 1}, 4, 0.1}};
  for (const bool first : {true, false}) {
    Reconstruction both = result;
    both.objects.insert(first ? both.objects.begin() : both.objects.end(), phantom);
    reject_contradicted(views, {}, both, {.missing_features = false});
    REQUIRE(both.objects.size() == 1);
    CHECK(both.objects[0].type->name == right->name);
    CHECK(both.objects[0].probability > 0.99);
    REQUIRE(both.rejected.size() == 1);
    CHECK(both.rejected[0].object.evidence->other_objects < -5);
  }
}

TEST_CASE("behind a wall, below the table, or in a structure: not there, with the reason") {
  Random random(6);
  auto views = four_cameras();
  const TypePtr type = evident_cube();
  look_at(views, {{type, Pose::from_translation({0, 0, 0.04})}}, {.sigma_px = 0.05}, random);
  const Reconstruction result = found_in(views, {type});
  REQUIRE(result.objects.size() == 1);
  const auto rejected_by = [&](const KnownObject& solid, const char* words) {
    CAPTURE(solid.name);
    Reconstruction judged = result;
    reject_contradicted(views, {{solid}}, judged);
    CHECK(judged.objects.empty());
    CHECK(reason_has(judged, words));
  };
  rejected_by(slab("the wall", {0.02, 0.6, 0.6}, {0.25, 0, 0.3}), "would be hidden from image");
  rejected_by(slab("the table", {1, 1, 0.02}, {0, 0, 0.15}), "would be hidden from image");
  Reconstruction standing = result;
  reject_contradicted(views, {{slab("the table", {1, 1, 0.02}, {0, 0, -0.01})}}, standing);
  CHECK(standing.objects.size() == 1);
  CHECK(standing.objects[0].evidence->inside_structure == 0);

  // A single sighting that reaches into the table from above.
  ReconstructedObject sunk{type, Pose::from_translation({0, 0, 0.01})};
  sunk.support = {{{0, 0}, 4, 0.1}};
  Reconstruction into{{sunk}, {}, StopReason::none};
  reject_contradicted(views, {{slab("the table", {1, 1, 0.2}, {0, 0, -0.1})}}, into,
                      {.missing_features = false});
  CHECK(reason_has(into, "would reach into the table"));
}

TEST_CASE("right objects are never taken out: random scenes with dropped markers, with depth") {
  Random random(7);
  std::size_t before = 0, after = 0;
  for (std::uint32_t s = 0; s < scene_count(30); ++s) {
    CAPTURE(s);
    auto views = four_cameras();
    const std::vector<TypePtr> types = {evident_cube(0, 0.05), evident_cube(6, 0.06)};
    auto objects = scattered(random, types, 7, 0.2);
    for (std::size_t i = 0; i < objects.size(); ++i) {
      const Eigen::Vector3d at = objects[i].T_world_object.translation();
      const double half_m = objects[i].type == types[0] ? 0.025 : 0.03;
      objects[i].T_world_object = Pose::from_rotation(
          Eigen::AngleAxisd(random.uniform(0, 6), Eigen::Vector3d::UnitZ()).matrix(),
          {at.x(), at.y(), half_m});
    }
    look_at(views, objects, {.sigma_px = 0.1, .missing = 0.2}, random);
    Reconstruction result = found_in(views, types);
    SceneKnowledge knowledge;
    knowledge.solids = {slab("the table", {2, 2, 0.02}, {0, 0, -0.01})};
    knowledge.depth = ideal_depth(views, objects);
    before += result.objects.size();
    reject_contradicted(views, knowledge, result);
    after += result.objects.size();
    for (const ReconstructedObject& object : result.objects) {
      CHECK(object.probability > 0.5);
      CHECK(object.evidence->hidden_by_structure == 0);
      CHECK(object.evidence->inside_structure == 0);
    }
  }
  CHECK(before > enough(100));
  CHECK(after == before);
}

}  // namespace vantage::test
