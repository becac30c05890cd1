#include <doctest/doctest.h>

#include <Eigen/Geometry>

#include "reference/plain_distance.hpp"
#include "simulator/placement/collision.hpp"
#include "simulator/resting_bodies.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

using Eigen::Vector3d;

struct Body {
  TriangleMesh mesh;
  CollisionShape shape;
  explicit Body(TriangleMesh m) : mesh(std::move(m)), shape(mesh) {}
};

bool closer(double gap_m, const Body& a, const Pose& T_world_a, const Body& b,
            const Pose& T_world_b) {
  const bool result = closer_than(gap_m, a.shape, T_world_a, b.shape, T_world_b);
  CHECK(result == closer_than(gap_m, b.shape, T_world_b, a.shape, T_world_a));
  return result;
}

Pose shifted(double x, double y, double z) {
  return Pose::from_translation({x, y, z});
}

TriangleCorners random_triangle(Random& random, const Vector3d& middle) {
  return {middle + random.in_cube(1), middle + random.in_cube(1), middle + random.in_cube(1)};
}

TriangleMesh one_triangle(const TriangleCorners& corners) {
  return {{corners[0].cast<float>(), corners[1].cast<float>(), corners[2].cast<float>()},
          {{0, 1, 2}}};
}

}  // namespace

TEST_CASE("triangle distance: that of the plain search, for random triangles that do not cross") {
  Random random(41);
  int compared = 0;
  for (std::uint32_t i = 0; i < scene_count(3000); ++i) {
    const TriangleMesh first = one_triangle(random_triangle(random, Vector3d::Zero()));
    const TriangleMesh second = one_triangle(random_triangle(random, random.in_cube(1.5)));
    const double expected = surface_distance(first, {}, second, {});
    if (expected == 0) continue;
    const auto corners = [](const TriangleMesh& mesh) {
      return TriangleCorners{mesh.vertices()[0].cast<double>(), mesh.vertices()[1].cast<double>(),
                             mesh.vertices()[2].cast<double>()};
    };
    CHECK(distance_of_uncrossed(corners(first), corners(second)) ==
          doctest::Approx(expected).epsilon(1e-6));
    ++compared;
  }
  CHECK(compared > int(scene_count(1500)));
}

TEST_CASE("triangle distance: parallel edges and faces") {
  const TriangleCorners flat = {Vector3d(0, 0, 0), Vector3d(1, 0, 0), Vector3d(0, 1, 0)};
  const auto moved = [&](const Vector3d& by) {
    return TriangleCorners{flat[0] + by, flat[1] + by, flat[2] + by};
  };
  CHECK(distance_of_uncrossed(flat, moved({0.1, 0.1, 0.25})) == doctest::Approx(0.25));
  CHECK(distance_of_uncrossed(flat, moved({0, -1.5, 0})) == doctest::Approx(0.5));
  CHECK(distance_of_uncrossed(flat, moved({3, 0, 0})) == doctest::Approx(2));
  CHECK(distance_of_uncrossed(flat, moved({4, -4, 0})) == doctest::Approx(std::hypot(3, 3)));
  CHECK(distance_of_uncrossed(flat, flat) == 0);
}

TEST_CASE("collision: two cubes, by a hair on either side of the gap") {
  const Body cube(cuboid(0.1, 0.1, 0.1));
  const double gap = 0.002;
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = [&](double d) { return Pose::from_translation(d * Vector3d::Unit(axis)); };
    const double touching = 2 * double(0.05f);
    CHECK_FALSE(closer(gap, cube, {}, cube, at(touching + gap + 1e-9)));
    CHECK(closer(gap, cube, {}, cube, at(touching + gap - 1e-9)));
    CHECK(closer(gap, cube, {}, cube, at(touching)));
    CHECK(closer(gap, cube, {}, cube, at(0.07)));
    CHECK(closer(gap, cube, {}, cube, {}));  // the very same place
  }
}

TEST_CASE("collision: what lies within a solid touches it, what stands in its hollow does not") {
  const Body ball(icosphere(0.1, 2)), small(cuboid(0.02, 0.02, 0.02));
  CHECK(surface_distance(ball.mesh, {}, small.mesh, {}) > 0.07);
  CHECK(closer(0.002, ball, {}, small, {}));
  CHECK(closer(0.002, ball, {}, small, shifted(0.05, 0.03, -0.02)));
  CHECK_FALSE(closer(0.002, ball, {}, small, shifted(0.12, 0, 0)));

  const Body bin(open_bin(0.1, 0.06, 0.01));
  CHECK_FALSE(closer(0.002, bin, {}, small, shifted(0, 0, 0.03)));
  CHECK_FALSE(closer(0.002, bin, {}, small, shifted(0.027, 0, 0.0225)));
  CHECK(closer(0.002, bin, {}, small, shifted(0.029, 0, 0.03)));  // near a wall
  CHECK(closer(0.002, bin, {}, small, shifted(0, 0, 0.021)));     // near the bottom
  CHECK(closer(0.002, bin, {}, small, shifted(0.045, 0, 0.03)));  // in a wall
  CHECK(closer(0.0005, bin, {}, Body(cuboid(0.006, 0.006, 0.006)), shifted(0.045, 0, 0.03)));
}

TEST_CASE("collision: random bodies, against every pair of triangles in double") {
  Random random(42);
  int near = 0, within = 0, free = 0;
  for (std::uint32_t i = 0; i < scene_count(200); ++i) {
    CAPTURE(i);
    const auto pick = [&]() -> TriangleMesh {
      switch (random.below(6)) {
        case 0:
          return cuboid(0.02, 0.01, 0.03);
        case 1:
          return rod(0.05, 0.1, 12);
        case 2:
          return bracket(0.15, 0.02);
        case 3:
          return open_bin(0.3, 0.2, 0.01);
        case 4:
          return icosphere(random.uniform(0.01, 0.1), 1);
        default:
          return random_convex_body(random);
      }
    };
    const bool nested = i % 4 == 0;  // what lies within the other, without touching its surface
    const Body a(nested ? icosphere(0.1, 1) : pick()),
        b(nested ? cuboid(0.02, 0.01, 0.03) : pick());
    const Pose T_world_a = random.pose(0.08), T_world_b = random.pose(0.08);
    const double gap = random.uniform(1e-4, 0.02);
    const double distance = surface_distance(a.mesh, T_world_a, b.mesh, T_world_b);
    const auto corner = [](const Body& body, const Pose& pose) {
      return pose * Vector3d(body.mesh.corner(0, 0).cast<double>());
    };
    const bool inside = surrounds(a.mesh, T_world_a, corner(b, T_world_b)) ||
                        surrounds(b.mesh, T_world_b, corner(a, T_world_a));
    CAPTURE(distance);
    CHECK(closer(gap, a, T_world_a, b, T_world_b) == (distance < gap || inside));
    ++(distance < gap ? near : inside ? within : free);
  }
  CHECK(near > 0);
  CHECK(within > 0);
  CHECK(free > 0);
}

TEST_CASE("collision: a mesh without triangles touches nothing") {
  const Body nothing((TriangleMesh())), cube(cuboid(0.1, 0.1, 0.1));
  CHECK_FALSE(closer(0.002, nothing, {}, cube, {}));
}

}  // namespace vantage::test
