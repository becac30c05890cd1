#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "reference/random_scene.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

const std::uint32_t kScenes = scene_count(240);
constexpr int kRaysPerScene = 50;

Ray random_ray(Random& random) {
  const Eigen::Vector3d origin = random.in_cube(1.5);
  const Eigen::Vector3d direction =
      random.below(2) == 0 ? random.direction() : random.in_cube(0.8) - origin;
  return {origin.cast<float>(), (random.uniform(0.1, 10) * direction).cast<float>()};
}

/// Everything that a hit tells, against the triangle that it names.
void check_hit(const RandomScene& s, const Ray& ray, const Hit& hit) {
  const WorldTriangle* triangle = s.reference.find(hit.object, hit.triangle);
  REQUIRE(triangle != nullptr);
  const Eigen::Vector3d o = ray.origin.cast<double>(), d = ray.direction.cast<double>();
  const Crossing expected = triangle->cross(o, d);
  const double error = std::abs(hit.t - expected.t);
  CHECK(error * d.norm() * expected.cosine < 3e-6);  // off the triangle's plane, metres
  if (expected.cosine > 0.05 && expected.t * d.norm() > 0.02) CHECK(error <= 1e-4 * expected.t);

  CHECK(hit.normal.norm() == doctest::Approx(1).epsilon(1e-6));
  CHECK(hit.normal.cast<double>().dot(expected.normal) > 1 - 1e-4);

  const auto& [a, b, c] = triangle->corners;
  const Eigen::Vector3d by_weights = a + double(hit.u) * (b - a) + double(hit.v) * (c - a);
  const Eigen::Vector3d by_t = o + double(hit.t) * d;
  if (expected.cosine > 0.05) CHECK((by_weights - by_t).norm() < 2e-5);
}

}  // namespace

TEST_CASE("closest hits match the twin on random scenes") {
  int rays = 0, skipped = 0, hits = 0;
  for (std::uint32_t seed = 0; seed < kScenes; ++seed) {
    const RandomScene s = random_scene(seed, seed % 2 == 1);
    Random random(seed + 100000);
    for (int i = 0; i < kRaysPerScene; ++i, ++rays) {
      const Ray ray = random_ray(random);
      const double infinity = std::numeric_limits<double>::infinity();
      const Verdict expected = s.reference.closest_hit(ray.origin, ray.direction, 0, infinity);
      const std::optional<Hit> hit = s.scene->closest_hit(ray);
      CAPTURE(seed);
      CAPTURE(i);
      if (hit) check_hit(s, ray, *hit);
      if (expected.close_call) {
        ++skipped;
        continue;
      }
      REQUIRE(hit.has_value() == expected.hit);
      if (!hit) continue;
      ++hits;
      const WorldTriangle* triangle = s.reference.find(hit->object, hit->triangle);
      const Crossing c = triangle->cross(ray.origin.cast<double>(), ray.direction.cast<double>());
      CHECK(c.t <= expected.t + 1e-5);  // nothing was in front of it
      CHECK(c.margin_m > -kCloseCall);
    }
  }
  MESSAGE("closest hits, seeds 0 to " << kScenes - 1 << ": " << rays << " rays, " << hits
                                      << " hits, " << skipped << " close calls left out");
  CHECK(skipped * 200 < rays);
  CHECK(hits * 4 > rays);
}

TEST_CASE("occlusion matches the twin on random scenes") {
  int rays = 0, skipped = 0, occluded = 0;
  for (std::uint32_t seed = 0; seed < kScenes; ++seed) {
    const RandomScene s = random_scene(seed, seed % 2 == 1);
    Random random(seed + 200000);
    for (int i = 0; i < kRaysPerScene; ++i, ++rays) {
      const Eigen::Vector3f from = random.in_cube(1.2).cast<float>();
      const Eigen::Vector3f to = random.in_cube(1.2).cast<float>();
      const Verdict expected = s.reference.occluded(from, to);
      const bool result = s.scene->occluded(from, to);
      if (expected.close_call) {
        ++skipped;
        continue;
      }
      CAPTURE(seed);
      CAPTURE(i);
      CHECK(result == expected.hit);
      occluded += result;
    }
  }
  MESSAGE("occlusion, seeds 0 to " << kScenes - 1 << ": " << rays << " segments, " << occluded
                                   << " occluded, " << skipped << " close calls left out");
  CHECK(skipped * 200 < rays);
  CHECK(occluded * 4 > rays);
  CHECK(occluded * 4 < 3 * rays);
}

TEST_CASE("the normals of a turned box look outwards, seen from both sides") {
  for (const bool as_instance : {false, true}) {
    const Box box({-0.1, -0.2, -0.3}, {0.1, 0.2, 0.3});
    Random random(3);
    const Pose T_world_box = random.pose(2);
    SceneBuilder builder;
    if (as_instance) {
      builder.add_instance(std::make_shared<TriangleMesh>(TriangleMesh::from_box(box)),
                           T_world_box);
    } else {
      builder.add_box(box, T_world_box);
    }
    const auto scene = builder.build();
    const Eigen::Vector3f centre = T_world_box.translation().cast<float>();
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        const Eigen::Vector3f outwards =
            (T_world_box.rotation() * (sign * Eigen::Vector3d::Unit(axis))).cast<float>();
        const auto from_inside = scene->closest_hit({centre, outwards});
        const auto from_outside = scene->closest_hit({centre + 2 * outwards, -outwards});
        REQUIRE((from_inside && from_outside));
        CHECK(from_inside->normal.isApprox(outwards, 1e-5f));
        CHECK(from_outside->normal.isApprox(outwards, 1e-5f));
        CHECK(from_inside->t == doctest::Approx(0.1 * (axis + 1)).epsilon(1e-5));
        CHECK(from_outside->t == doctest::Approx(2 - 0.1 * (axis + 1)).epsilon(1e-5));
      }
    }
  }
}

TEST_CASE("object ids follow the order of adding, objects without triangles included") {
  SceneBuilder builder;
  const auto cube = std::make_shared<TriangleMesh>(
      TriangleMesh::from_box(Box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1})));
  const auto nothing = std::make_shared<TriangleMesh>();
  CHECK(builder.add_mesh(*cube) == 0);
  CHECK(builder.add_mesh(TriangleMesh()) == 1);
  CHECK(builder.add_instance(cube, Pose::from_translation({1, 0, 0})) == 2);
  CHECK(builder.add_instance(nothing, {}) == 3);
  CHECK(builder.add_box(Box({1.9, -0.1, -0.1}, {2.1, 0.1, 0.1})) == 4);
  CHECK(builder.add_instance(cube, Pose::from_translation({3, 0, 0})) == 5);
  const auto scene = builder.build();
  CHECK(scene->object_count() == 6);
  CHECK(scene->triangle_count() == 48);
  for (const ObjectId id : {0u, 2u, 4u, 5u}) {
    const float x = id < 2 ? 0 : id == 2 ? 1 : id == 4 ? 2 : 3;
    const auto hit = scene->closest_hit({{x, 0.02f, 5}, {0, 0, -1}});
    REQUIRE(hit);
    CHECK(hit->object == id);
    CHECK(hit->triangle < 12);
  }
  CHECK(SceneBuilder().build()->object_count() == 0);
}

TEST_CASE("a builder is empty after build, and an empty scene is hit by nothing") {
  SceneBuilder builder;
  builder.add_box(Box({0, 0, 0}, {1, 1, 1}));
  const auto full = builder.build();
  const auto empty = builder.build();
  CHECK(full->occluded({0.5f, 0.4f, 2}, {0.5f, 0.4f, -1}));
  CHECK_FALSE(empty->occluded({0.5f, 0.4f, 2}, {0.5f, 0.4f, -1}));
  CHECK_FALSE(empty->closest_hit({{0.5f, 0.4f, 2}, {0, 0, -1}}));
  const Points points(0);
  Hits hits;
  empty->closest_hits(points, points, hits);
  CHECK(hits.size() == 0);
}

TEST_CASE("a ray counts hits from t_near to t_far") {
  SceneBuilder builder;
  builder.add_box(Box({0, 0, 0}, {1, 1, 1}));
  const auto scene = builder.build();
  Ray ray{{0.4f, 0.3f, 3}, {0, 0, -2}};
  CHECK(scene->closest_hit(ray)->t == doctest::Approx(1));
  ray.t_near = 1.1f;
  CHECK(scene->closest_hit(ray)->t == doctest::Approx(1.5));
  ray.t_far = 1.4f;
  CHECK_FALSE(scene->closest_hit(ray));
  ray.t_near = 0;
  ray.t_far = 0.9f;
  CHECK_FALSE(scene->closest_hit(ray));
}

TEST_CASE("a segment is closed: to touch is to be occluded") {
  SceneBuilder builder;
  builder.add_box(Box({0, 0, 0}, {1, 1, 1}));
  const auto scene = builder.build();
  for (int i = 1; i < 200; ++i) {
    const float x = 0.37f, y = 0.61f, height = 1 + 0.013f * float(i);
    CAPTURE(height);
    CHECK(scene->occluded({x, y, height}, {x, y, 1}));
    CHECK(scene->occluded({x, y, 1}, {x, y, height}));
    CHECK_FALSE(scene->occluded({x, y, height}, {x, y, 1.001f}));
    CHECK_FALSE(scene->occluded({x, y, 1.001f}, {x, y, height}));
  }
}

TEST_CASE("a triangle of a few picometres has a normal of unit length") {
  const float s = 1e-11f;
  SceneBuilder builder;
  builder.add_mesh(TriangleMesh({{-s, -s, 0}, {s, -s, 0}, {0, s, 0}}, {{0, 1, 2}}));
  const auto scene = builder.build();
  const auto hit = scene->closest_hit({{0, 0, 1}, {0, 0, -1}});
  REQUIRE(hit);
  CHECK(hit->normal.isApprox(Eigen::Vector3f::UnitZ(), 1e-5f));
  Points direction;
  direction.push_back({0, 0, -1});
  Hits hits;
  scene->closest_hits(Eigen::Vector3f(0, 0, 1), direction, hits);
  CHECK(hits.normal[0].isApprox(Eigen::Vector3f::UnitZ(), 1e-5f));
}

TEST_CASE("an instance must have a mesh, and a place that Embree can reach") {
  SceneBuilder builder;
  expect_bad_input("scene", "null", [&] { builder.add_instance(nullptr, {}); });
  const auto cube = std::make_shared<TriangleMesh>(
      TriangleMesh::from_box(Box({-0.1, -0.1, -0.1}, {0.1, 0.1, 0.1})));
  expect_bad_input("scene", "1e+300", [&] {
    builder.add_instance(cube, Pose::from_translation({0, 1e300, 0}));
  });
  CHECK(builder.build()->object_count() == 0);  // a refused object leaves nothing behind
}

TEST_CASE("a mesh that is refused or empty leaves the scene usable") {
  SceneBuilder builder;
  const Box unit({0, 0, 0}, {1, 1, 1});
  CHECK_THROWS_AS(builder.add_box(unit, Pose::from_translation({1e7, 0, 0})), Error);
  CHECK(builder.add_box(unit) == 0);
  CHECK(builder.build()->occluded({0.5f, 0.4f, 2}, {0.5f, 0.4f, -1}));
}

TEST_CASE("the triangles that a scene reports are those that rays meet") {
  for (std::uint32_t seed = 0; seed < 8; ++seed) {
    CAPTURE(seed);
    const RandomScene random = random_scene(seed, seed % 2 == 0);
    std::size_t count = 0;
    for (ObjectId object = 0; object < random.scene->object_count(); ++object) {
      for (std::size_t i = 0; i < random.scene->triangle_count(object); ++i, ++count) {
        const WorldTriangle* triangle = random.reference.find(object, std::uint32_t(i));
        REQUIRE(triangle != nullptr);
        const auto corners = random.scene->corners(object, i);
        for (std::size_t c = 0; c < 3; ++c) {
          CHECK((corners[c] - triangle->corners[c]).norm() < 1e-6);
        }
      }
    }
    CHECK(count == random.scene->triangle_count());
  }
}
