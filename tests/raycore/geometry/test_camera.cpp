#include "vantage/raycore/camera.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "reference/random_scene.hpp"
#include "support/expect_error.hpp"
#include "support/non_finite.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

const Intrinsics kKinect{640, 480, 525, 530, 319.5, 239.25};

PinholeCamera random_camera(Random& random) {
  const Intrinsics k{320,
                     240,
                     random.uniform(200, 500),
                     random.uniform(200, 500),
                     random.uniform(100, 220),
                     random.uniform(80, 160)};
  return {k, Pose::looking_at(2 * random.direction(), random.in_cube(0.2)), {0.5, 3.0}};
}

/// How far inside the view a point is, by double arithmetic and divisions: pixels and metres.
double inside_by(const PinholeCamera& camera, const Eigen::Vector3d& p_world) {
  const auto p = camera.project(p_world);
  if (!p) return -1;
  const Intrinsics& k = camera.intrinsics();
  return std::min({p->u + 0.5, k.width - 0.5 - p->u, p->v + 0.5, k.height - 0.5 - p->v,
                   1000 * (p->depth - camera.range().near_m),
                   1000 * (camera.range().far_m - p->depth)});
}

}  // namespace

TEST_CASE("a camera at the origin projects as the pinhole model says") {
  const PinholeCamera camera(kKinect, Pose());
  const auto p = camera.project({0.2, -0.1, 2});
  REQUIRE(p);
  CHECK(p->u == doctest::Approx(319.5 + 525 * 0.1));
  CHECK(p->v == doctest::Approx(239.25 - 530 * 0.05));
  CHECK(p->depth == 2);
  CHECK_FALSE(camera.project({0.2, -0.1, 0}));
  CHECK_FALSE(camera.project({0.2, -0.1, -2}));
  CHECK_FALSE(camera.project({kNaN, kNaN, kNaN}));
}

TEST_CASE("project, unproject and pixel_ray undo each other") {
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const PinholeCamera camera = random_camera(random);
    const double u = random.uniform(-50, 400), v = random.uniform(-50, 300);
    const double depth = random.uniform(0.01, 5);
    const Eigen::Vector3d p = camera.unproject(u, v, depth);
    const auto back = camera.project(p);
    REQUIRE(back);
    CHECK(std::abs(back->u - u) < 1e-9);
    CHECK(std::abs(back->v - v) < 1e-9);
    CHECK(std::abs(back->depth - depth) < 1e-12);
    const PixelRay ray = camera.pixel_ray(u, v);
    CHECK(ray.origin == camera.centre());
    CHECK((ray.origin + depth * ray.direction - p).norm() < 1e-12);
  }
}

TEST_CASE("batches agree with single points") {
  Random random(2);
  for (const std::size_t size : {0, 1, 15, 16, 17, 1000}) {
    const PinholeCamera camera = random_camera(random);
    std::vector<float> u(size), v(size), depth(size), u2(size), v2(size), depth2(size);
    for (std::size_t i = 0; i < size; ++i) {
      u[i] = float(random.uniform(0, 320)), v[i] = float(random.uniform(0, 240));
      depth[i] = float(random.uniform(0.3, 4));
    }
    const Points points = camera.unproject(u, v, depth);
    const Points directions = camera.pixel_directions(u, v);
    camera.project(points, u2, v2, depth2);
    REQUIRE((points.size() == size && directions.size() == size));
    for (std::size_t i = 0; i < size; ++i) {
      const double ui = double(u[i]), vi = double(v[i]), di = double(depth[i]);
      CHECK(points[i] == camera.unproject(ui, vi, di).cast<float>());
      CHECK(directions[i] == camera.pixel_ray(ui, vi).direction.cast<float>());
      CHECK(std::abs(u2[i] - u[i]) < 2e-3f);
      CHECK(std::abs(v2[i] - v[i]) < 2e-3f);
      CHECK(std::abs(depth2[i] - depth[i]) < 2e-6f);
    }
  }
}

TEST_CASE("in_view: batch and single agree to the bit, and with the twin away from the borders") {
  Random random(3);
  int visible = 0, close = 0, points_seen = 0;
  for (int c = 0; c < 60; ++c) {
    const PinholeCamera camera = random_camera(random);
    const std::size_t size = 1 + random.below(700);
    Points points(size);
    for (std::size_t i = 0; i < size; ++i) points.set(i, random.in_cube(1.5).cast<float>());
    std::vector<std::uint8_t> result(size, 7);
    camera.in_view(points, result);
    for (std::size_t i = 0; i < size; ++i, ++points_seen) {
      CHECK(result[i] == std::uint8_t(camera.in_view(points[i])));
      const double inside = inside_by(camera, points[i].cast<double>());
      if (std::abs(inside) < 0.01) {
        ++close;
        continue;
      }
      CHECK(result[i] == (inside > 0));
      visible += result[i];
    }
  }
  CHECK(close * 100 < points_seen);
  CHECK(visible * 10 > points_seen);
}

TEST_CASE("in_view counts pixels from -0.5 up to, but not including, size - 0.5") {
  // Powers of two: the arithmetic is exact, so that the border itself can be tested.
  const PinholeCamera camera({64, 32, 64, 64, 31.5, 15.5}, Pose(), {0.5, 4.0});
  const auto at = [&](double u, double v, double depth) {
    return camera.in_view(camera.unproject(u, v, depth).cast<float>());
  };
  CHECK(at(-0.5, 10, 1));
  CHECK_FALSE(at(-0.5 - 1e-4, 10, 1));
  CHECK_FALSE(at(63.5, 10, 1));
  CHECK(at(63.5 - 1e-4, 10, 1));
  CHECK(at(10, -0.5, 1));
  CHECK_FALSE(at(10, -0.5 - 1e-4, 1));
  CHECK_FALSE(at(10, 31.5, 1));
  CHECK(at(10, 31.5 - 1e-4, 1));
  CHECK(at(10, 10, 0.5));
  CHECK(at(10, 10, 4.0));
  CHECK_FALSE(at(10, 10, 0.4999));
  CHECK_FALSE(at(10, 10, 4.001));
  CHECK_FALSE(at(31.5, 15.5, -1));
  CHECK_FALSE(camera.in_view({0, 0, kNaN}));
  CHECK_FALSE(camera.in_view({kInfinity, 0, 1}));
}

TEST_CASE("invalid intrinsics are refused with the value") {
  const auto refuse = [](Intrinsics k, const char* message) {
    expect_bad_input("frame 3", message, [&] { PinholeCamera(k, Pose(), {}, "frame 3"); });
  };
  const auto with = [](auto member, auto value) {
    Intrinsics k = kKinect;
    k.*member = value;
    return k;
  };
  refuse(with(&Intrinsics::width, 0), "width is 0");
  refuse(with(&Intrinsics::width, 16385), "width is 16385");
  refuse(with(&Intrinsics::height, -4), "height is -4");
  refuse(with(&Intrinsics::fx, 0.0), "fx is 0");
  refuse(with(&Intrinsics::fx, -525.0), "fx is -525");
  refuse(with(&Intrinsics::fy, kNaN), "fy is nan");
  refuse(with(&Intrinsics::fy, kInfinity), "fy is inf");
  refuse(with(&Intrinsics::fx, 1e-300), "fx is 1e-300; expected 0.00064 to 1e+07");
  refuse(with(&Intrinsics::fy, 1e300), "fy is 1e+300");
  refuse(with(&Intrinsics::cx, -1e300), "cx is -1e+300");
  refuse(with(&Intrinsics::cx, kNaN), "cx is nan");
  refuse(with(&Intrinsics::cy, kInfinity), "cy is inf");
}

TEST_CASE("an invalid depth range is refused with the values") {
  const auto refuse = [](DepthRange range, const char* message) {
    expect_bad_input("arm", message, [&] { PinholeCamera(kKinect, Pose(), range, "arm"); });
  };
  refuse({0, 3}, "near depth is 0");
  refuse({-1, 3}, "near depth is -1");
  refuse({kNaN, 3}, "near depth is nan");
  refuse({0.1, kInfinity}, "far depth is inf");
  refuse({2, 2}, "from 2 to 2");
  refuse({3, 2}, "from 3 to 2");
}

TEST_CASE("arrays of different sizes are refused") {
  const PinholeCamera camera(kKinect, Pose());
  std::vector<float> three(3), four(4);
  std::vector<std::uint8_t> flags(3);
  const Points points(4);
  expect_bad_input("batch", "3 elements; expected 4",
                   [&] { camera.project(points, four, three, four); });
  expect_bad_input("batch", "3 elements; expected 4",
                   [&] { (void)camera.unproject(four, four, three); });
  expect_bad_input("batch", "4 elements; expected 3",
                   [&] { (void)camera.pixel_directions(three, four); });
  expect_bad_input("batch", "3 elements; expected 4", [&] { camera.in_view(points, flags); });
}

TEST_CASE("a camera can be moved and keeps what it is") {
  const PinholeCamera camera(kKinect, Pose(), {0.2, 2.5});
  const PinholeCamera moved = camera.moved_to(Pose::from_translation({1, 2, 3}));
  CHECK(moved.centre() == Eigen::Vector3d(1, 2, 3));
  CHECK(moved.intrinsics() == kKinect);
  CHECK(moved.range() == DepthRange{0.2, 2.5});
}
