#include "simulator/sequence/marker_sight.hpp"

#include <doctest/doctest.h>

#include "simulator/sequence/sequence_scenes.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage::test {
namespace {

const SequenceCamera kAbove = sequence_camera("above", {0, 0.01, 0.5});

/// A cube at the origin, and a rod over it.
std::shared_ptr<const Scene> cube_and(const ObjectType& cube, std::optional<Box> other = {}) {
  SceneBuilder builder;
  builder.add_mesh(*cube.mesh);
  if (other) builder.add_box(*other);
  return builder.build();
}

}  // namespace

TEST_CASE("a marker in full view is seen where its corners are, one turned away is not") {
  const TypePtr cube = marked_cube("cube", 0);
  const auto scene = cube_and(*cube);
  const auto markers = cube->markers();
  const auto sight = see_marker(markers[2], {}, kAbove, *scene);  // +z
  REQUIRE(sight);
  CHECK(sight->recall == 1);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto truth = kAbove.camera.project(markers[2].corners()[i]);
    CHECK((sight->corners_px[i] - Eigen::Vector2d(truth->u, truth->v)).norm() < 1e-9);
  }
  CHECK_FALSE(see_marker(markers[5], {}, kAbove, *scene));  // -z
  CHECK_FALSE(see_marker(markers[0], {}, kAbove, *scene));  // +x, edge on
}

TEST_CASE("a rod over the middle hides a marker, though all of its corners are free") {
  const TypePtr cube = marked_cube("cube", 0);
  const auto hidden = cube_and(*cube, Box({-0.1, -0.006, 0.06}, {0.1, 0.006, 0.07}));
  CHECK_FALSE(see_marker(cube->markers()[2], {}, kAbove, *hidden));
  const auto beside = cube_and(*cube, Box({-0.1, 0.03, 0.06}, {0.1, 0.04, 0.07}));
  CHECK(see_marker(cube->markers()[2], {}, kAbove, *beside));
}

TEST_CASE("what reaches beyond the image or is too small is not seen") {
  const TypePtr cube = marked_cube("cube", 0);
  const Pose aside = Pose::from_translation({0.24, 0, 0});
  SceneBuilder builder;
  builder.add_mesh(cube->mesh->transformed(aside));
  CHECK_FALSE(see_marker(cube->markers()[2], aside, kAbove, *builder.build()));
  const SequenceCamera far = sequence_camera("far", {0, 0.01, 5});
  CHECK_FALSE(see_marker(cube->markers()[2], {}, far, *cube_and(*cube)));
}

}  // namespace vantage::test
