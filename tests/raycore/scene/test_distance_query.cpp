#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "reference/plain_nearness.hpp"
#include "reference/random_scene.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage::test {
namespace {

constexpr double kSlack = 2e-6;  // instances are placed in float
const Box kCube({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1});

/// What `closer_than` has to say around a distance that is known.
template <class CloserThan>
void expect_distance(double distance_m, const CloserThan& closer_than) {
  CAPTURE(distance_m);
  if (!std::isfinite(distance_m)) {
    REQUIRE_FALSE(closer_than(1e6));
    return;
  }
  REQUIRE(closer_than(distance_m + kSlack));
  REQUIRE(closer_than(2 * distance_m + 0.1));
  if (distance_m <= kSlack) return;
  REQUIRE_FALSE(closer_than(distance_m - kSlack));
  REQUIRE_FALSE(closer_than(distance_m / 2));
}

Box random_box(Random& random) {
  const Eigen::Vector3d min = random.in_cube(0.3);
  Eigen::Vector3d size;
  for (double& side : size) side = std::exp(random.uniform(std::log(0.003), std::log(0.6)));
  return {min, min + size};
}

/// Closed objects that overlap each other, and partly themselves.
RandomScene closed_scene(std::uint32_t seed) {
  Random random(seed);
  RandomScene result;
  SceneBuilder builder;
  const auto shared = std::make_shared<const TriangleMesh>(icosphere(0.25, 1));
  for (int i = 0; i < 9; ++i) {
    const Pose pose = random.pose(0.6);
    if (i % 3 == 0) {
      result.reference.add(*shared, pose, builder.add_instance(shared, pose));
      continue;
    }
    TriangleMesh mesh = height_field_block(random, 3);
    if (i % 3 == 1) {
      mesh = TriangleMesh::from_boxes(std::vector{random_box(random), random_box(random)});
    }
    mesh = mesh.transformed(pose);
    result.reference.add(mesh, {}, builder.add_mesh(mesh));
  }
  result.scene = builder.build();
  return result;
}

}  // namespace

TEST_CASE("a cube's distances to points and boxes") {
  SceneBuilder builder;
  builder.add_box(kCube);
  const auto scene = builder.build();
  const auto at = [&](double x, double y, double z) {
    return [=](double d) { return scene->closer_than(d, Eigen::Vector3d(x, y, z)); };
  };
  expect_distance(0.4, at(0.5, 0, 0));                             // a face
  expect_distance(std::hypot(0.4, 0.2), at(0.5, 0.3, 0.05));       // an edge
  expect_distance(std::hypot(0.1, 0.2, 0.2), at(0.2, -0.3, 0.3));  // a corner
  expect_distance(0.03, at(0.07, 0.01, -0.02));                    // from inside
  const Box body({-0.02, -0.03, -0.04}, {0.02, 0.03, 0.04});
  const auto box_at = [&](double x, double y, double z) {
    const Pose pose = Pose::from_translation({x, y, z});
    return [=](double d) { return scene->closer_than(d, body, pose); };
  };
  expect_distance(0.38, box_at(0.5, 0, 0));
  expect_distance(std::hypot(0.38, 0.37), box_at(0.5, 0.5, 0.05));
  expect_distance(0, box_at(0.11, 0, 0));  // crosses a face
  expect_distance(0.06, box_at(0, 0, 0));  // inside: the cube's walls are 6 cm away
  CHECK(scene->closer_than(0, Box({-1, -1, -1}, {1, 1, 1}), Pose()));  // around it
  CHECK_FALSE(scene->closer_than(0, body, Pose()));
  CHECK_FALSE(scene->closer_than(0, Eigen::Vector3d(0.1, 0, 0)));  // on it is not less than 0
  // Over an edge, where a box that is merely larger would touch.
  const Box grown({-0.05, -0.05, -0.05}, {0.05, 0.05, 0.05});
  const Pose diagonal = Pose::from_translation({0.24, 0.24, 0});
  CHECK_FALSE(scene->closer_than(0.12, grown, diagonal));
  CHECK(scene->closer_than(0.13, grown, diagonal));
}

TEST_CASE("distances are those of the slow twin, of all objects and of one") {
  std::size_t inside = 0, far = 0;
  for (std::uint32_t seed = 0; seed < scene_count(40); ++seed) {
    CAPTURE(seed);
    Random random(1000 + seed);
    const RandomScene scene = random_scene(seed, seed % 2 == 0);
    for (int i = 0; i < 20; ++i) {
      const ObjectId objects = ObjectId(scene.scene->object_count());
      const ObjectId object = i % 2 == 0 ? kNoObject : ObjectId(random.below(objects));
      const Eigen::Vector3d point = random.in_cube(2);
      expect_distance(nearest_surface(scene.reference, point, object),
                      [&](double d) { return scene.scene->closer_than(d, point, object); });
      if (i >= 2) continue;
      const Box box = random_box(random);
      const Pose pose = random.pose(1);
      const double distance = nearest_surface(scene.reference, box, pose, object);
      inside += distance == 0, far += distance > 0.1;
      expect_distance(distance,
                      [&](double d) { return scene.scene->closer_than(d, box, pose, object); });
    }
  }
  CHECK(inside >= enough(6));
  CHECK(far >= enough(10));
}

TEST_CASE("enclosed is what an object's solid angles surround") {
  std::size_t in = 0, out = 0;
  for (std::uint32_t seed = 0; seed < scene_count(40); ++seed) {
    CAPTURE(seed);
    Random random(2000 + seed);
    const RandomScene scene = closed_scene(seed);
    for (int i = 0; i < 100; ++i) {
      const Eigen::Vector3d point = random.in_cube(1);
      if (nearest_surface(scene.reference, point) < 1e-5) continue;
      const bool expected = surrounded(scene.reference, point);
      REQUIRE(scene.scene->encloses(point) == expected);
      ++(expected ? in : out);
    }
  }
  CHECK(in >= enough(300));
  CHECK(out >= enough(500));
}

TEST_CASE("nothing is near, and nothing encloses, where there is nothing") {
  SceneBuilder builder;
  CHECK_FALSE(builder.build()->closer_than(1e9, Eigen::Vector3d(0, 0, 0)));
  builder.add_mesh({});
  const auto empty = builder.build();
  CHECK_FALSE(empty->closer_than(10, kCube, Pose()));
  CHECK_FALSE(empty->encloses({0, 0, 0}));

  // A table top without an underside is no solid, from neither side.
  builder.add_mesh({{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  const auto sheet = builder.build();
  CHECK_FALSE(sheet->encloses({0, 0, 0.1}));
  CHECK_FALSE(sheet->encloses({0, 0, -0.1}));
}

TEST_CASE("boxes that stand on each other surround what is in them only") {
  SceneBuilder builder;
  for (int i = 0; i < 3; ++i) builder.add_box(Box({-1, -1, 1.0 * i}, {1, 1, 1.0 + i}));
  builder.add_box(Box({-1, -1, 5}, {1, 1, 6}));
  const auto scene = builder.build();
  for (const double z : {0.5, 1.5, 2.5, 5.5}) CHECK(scene->encloses({0.1, 0.2, z}));
  for (const double z : {-0.5, 3.5, 6.5}) CHECK_FALSE(scene->encloses({0.1, 0.2, z}));
}

TEST_CASE("between pads in a frame that touches them is outside") {
  SceneBuilder builder;
  builder.add_mesh(TriangleMesh::from_boxes(  // a U, open along x
      std::vector{Box({-1, -1, 2}, {1, 1, 3}), Box({-1, -1, -3}, {1, 1, -2})}));
  builder.add_box(Box({-1, -1, 1}, {1, 1, 2}));
  builder.add_box(Box({-1, -1, -2}, {1, 1, -1}));
  const auto scene = builder.build();
  CHECK_FALSE(scene->encloses({0.1, 0.2, 0}));
  for (const double z : {-2.5, -1.5, 1.5, 2.5}) CHECK(scene->encloses({0.1, 0.2, z}));
}

TEST_CASE("invalid queries are refused") {
  SceneBuilder builder;
  builder.add_box(kCube);
  const auto scene = builder.build();
  const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
  const Eigen::Vector3d origin(0, 0, 0);
  expect_bad_input("point", "nan", [&] { scene->closer_than(1, Eigen::Vector3d(0, nan, 0)); });
  expect_bad_input("point", "2000000000",
                   [&] { scene->closer_than(1, Eigen::Vector3d(0, 0, 2e9)); });
  expect_bad_input("distance", "-1 m", [&] { scene->closer_than(-1, origin); });
  expect_bad_input("distance", "inf m", [&] { scene->closer_than(infinite, origin); });
  expect_bad_input("distance", "nan m", [&] { scene->closer_than(nan, kCube, Pose()); });
  expect_bad_input("point", "2000000000", [&] {
    scene->closer_than(0, kCube, Pose::from_translation({2e9, 0, 0}));
  });
  expect_bad_input("ray", "nan", [&] { scene->encloses({0, 0, nan}); });
}

}  // namespace vantage::test
