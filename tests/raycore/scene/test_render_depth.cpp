#include <doctest/doctest.h>

#include <cmath>

#include "reference/random_scene.hpp"
#include "support/expect_error.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

/// A wall of two triangles at z = `z`, ten metres wide.
TriangleMesh wall(float z) {
  return {{{-5, -5, z}, {5, -5, z}, {5, 5, z}, {-5, 5, z}}, {{0, 1, 2}, {0, 2, 3}}};
}

}  // namespace

TEST_CASE("the depth of a wall is its distance along the optical axis, at every image size") {
  SceneBuilder builder;
  builder.add_mesh(wall(2));
  const auto scene = builder.build();
  for (const auto& [width, height] :
       {std::pair{1, 1}, {2, 3}, {4, 4}, {5, 7}, {64, 48}, {63, 49}, {641, 3}, {3, 1025}}) {
    const PinholeCamera camera({width, height, 500, 500, width / 2.0, height / 2.0}, Pose());
    const DepthImage depth = scene->render_depth(camera);
    REQUIRE((depth.width() == width && depth.height() == height));
    int wrong = 0;
    for (const float metres : depth.metres()) wrong += !(std::abs(metres - 2) < 1e-5f);
    CHECK(wrong == 0);
  }
}

TEST_CASE("a tilted camera sees the analytic depth of the floor") {
  SceneBuilder builder;
  builder.add_mesh(wall(0));
  const auto scene = builder.build();
  const PinholeCamera camera({101, 75, 120, 110, 50, 37},
                             Pose::looking_at({0.9, -0.7, 1.1}, {0.1, 0.2, 0}));
  const DepthImage depth = scene->render_depth(camera);
  for (int v = 0; v < 75; ++v) {
    for (int u = 0; u < 101; ++u) {
      const PixelRay ray = camera.pixel_ray(u, v);
      const double expected = -ray.origin.z() / ray.direction.z();
      if (!(expected > 0 && expected < 3)) continue;
      CHECK(std::abs(double(depth.at(u, v)) - expected) < 1e-5);
    }
  }
}

TEST_CASE("every pixel of a box has its analytic depth") {
  const Eigen::Vector3d half(0.2, 0.15, 0.1);
  Random random(5);
  for (int i = 0; i < 10; ++i) {
    const Pose T_world_box = random.pose(0.2);
    SceneBuilder builder;
    builder.add_box(Box(-half, half), T_world_box);
    const auto scene = builder.build();
    const PinholeCamera camera({90, 70, 150, 150, 45, 35},
                               Pose::looking_at(1.5 * random.direction(), {0, 0, 0}));
    const DepthImage depth = scene->render_depth(camera);
    int seen = 0;
    for (int v = 0; v < 70; ++v) {
      for (int u = 0; u < 90; ++u) {
        // The slab test, in the box's frame.
        const PixelRay ray = camera.pixel_ray(u, v);
        const Eigen::Vector3d o = T_world_box.inverse() * ray.origin;
        const Eigen::Vector3d d = T_world_box.rotation().transpose() * ray.direction;
        const Eigen::Array3d a = (-half - o).array() / d.array(),
                             b = (half - o).array() / d.array();
        const double enter = a.min(b).maxCoeff(), leave = a.max(b).minCoeff();
        if (std::abs(leave - enter) < 1e-3) continue;  // at the silhouette
        if (enter < leave) {
          CHECK(std::abs(double(depth.at(u, v)) - enter) < 1e-5);
          ++seen;
        } else {
          CHECK(std::isnan(depth.at(u, v)));
        }
      }
    }
    CHECK(seen > 100);
  }
}

TEST_CASE("a fine sphere has nearly the sphere's depth") {
  SceneBuilder builder;
  builder.add_instance(std::make_shared<TriangleMesh>(icosphere(0.5, 6)),
                       Pose::from_translation({0, 0, 2}));
  const auto scene = builder.build();
  const PinholeCamera camera({81, 81, 200, 200, 40, 40}, Pose());
  const DepthImage depth = scene->render_depth(camera);
  CHECK(depth.at(40, 40) == doctest::Approx(1.5).epsilon(1e-4));
  for (int u = 10; u <= 70; ++u) {
    const Eigen::Vector3d d = camera.pixel_ray(u, 40).direction;
    const double a = d.squaredNorm(), b = 2 * d.z(), c = 4 - 0.25;  // |t d - (0, 0, 2)| = 0.5
    const double root = b * b - a * c;
    if (root < 0.02) continue;
    CHECK(std::abs(double(depth.at(u, 40)) - (b - std::sqrt(root)) / a) < 5e-4);
  }
  CHECK(std::isnan(depth.at(0, 0)));
}

TEST_CASE("what lies outside the range is unknown, and hides what is behind it") {
  const auto depth_of = [](std::initializer_list<float> walls) {
    SceneBuilder builder;
    for (const float z : walls) builder.add_mesh(wall(z));
    const PinholeCamera camera({9, 6, 20, 20, 4, 3}, Pose(), {0.5, 2.0});
    return builder.build()->render_depth(camera);
  };
  const auto all_unknown = [](const DepthImage& depth) {
    for (const float metres : depth.metres()) {
      if (!std::isnan(metres)) return false;
    }
    return true;
  };
  CHECK(all_unknown(depth_of({})));
  CHECK(all_unknown(depth_of({0.45f})));
  CHECK(all_unknown(depth_of({2.05f})));
  CHECK(all_unknown(depth_of({-1.0f})));
  CHECK(depth_of({1.0f, 1.5f}).at(4, 3) == doctest::Approx(1));
  CHECK(depth_of({0.51f}).at(4, 3) == doctest::Approx(0.51));
  CHECK(depth_of({1.99f}).at(4, 3) == doctest::Approx(1.99));
  CHECK(all_unknown(depth_of({0.3f, 1.0f})));  // no sensor looks through what is too near
}

TEST_CASE("a camera too far out to trace from is refused by its place") {
  SceneBuilder builder;
  builder.add_mesh(wall(2));
  const auto scene = builder.build();
  const PinholeCamera camera({9, 6, 20, 20, 4, 3}, Pose::from_translation({0, 2e9, 0}));
  expect_bad_input("camera", "2000000000", [&] { (void)scene->render_depth(camera); });
}
