#include "simulator/placement/random_stack.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "reference/plain_equilibrium.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage::test {
namespace {

using MeshPointer = std::shared_ptr<const TriangleMesh>;

/// A cube stands upright whichever of its faces it lies on.
StackedBox as_box(const StackedBody& body, double edge_m) {
  const Eigen::Matrix3d& rotation = body.T_world_body.rotation();
  int across = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (std::abs(rotation(2, axis)) < std::abs(rotation(2, across))) across = axis;
  }
  return {{edge_m, edge_m, edge_m},
          body.T_world_body.translation(),
          std::atan2(rotation(1, across), rotation(0, across))};
}

}  // namespace

TEST_CASE("random stacks stand, unless they are made to have a fault") {
  const std::vector<double> edges{0.04, 0.05, 0.06};
  std::vector<MeshPointer> meshes;
  for (const double edge : edges) {
    meshes.push_back(std::make_shared<TriangleMesh>(box_solid({edge, edge, edge})));
  }
  const StackMaker maker(meshes);
  for (std::uint64_t seed = 0; seed < scene_count(12); ++seed) {
    for (const StackFault fault : {StackFault::none, StackFault::removed, StackFault::shifted}) {
      CAPTURE(seed);
      CAPTURE(int(fault));
      const RandomStack stack = maker.make(fault, seed, {0.1, -0.2});
      CHECK(stack.fault == fault);
      CHECK(stack.bodies.size() >= 2);
      CHECK(stack.bodies.size() <= 4);
      CHECK((stack.broken_at == stack.bodies.size()) == (fault == StackFault::none));
      std::vector<StackedBox> boxes;
      for (const StackedBody& body : stack.bodies) {
        StackedBox box = as_box(body, edges[body.mesh]);
        // Rotations are rounded; heights are to agree to a micrometre.
        box.centre.z() = std::round(box.centre.z() * 1e6) / 1e6;
        boxes.push_back(box);
      }
      // 2 mm inside at least, 15 mm outside, up to the grid of the plain forces.
      if (fault == StackFault::none) CHECK(plain_unbalance(boxes, 0) < 1e-2);
      if (fault != StackFault::none) CHECK(plain_unbalance(boxes, 0) > 1e-2);
      const RandomStack again = maker.make(fault, seed, {0.1, -0.2});
      for (std::size_t i = 0; i < stack.bodies.size(); ++i) {
        CHECK(again.bodies[i].T_world_body.translation() ==
              stack.bodies[i].T_world_body.translation());
      }
    }
  }
}

TEST_CASE("what nothing can stand on makes no stack") {
  // A tetrahedron has a corner on top, whichever of its faces it lies on.
  const std::vector<MeshPointer> meshes{std::make_shared<TriangleMesh>(
      std::vector<Eigen::Vector3f>{{0, 0, 0}, {0.05f, 0, 0}, {0, 0.05f, 0}, {0, 0, 0.05f}},
      std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}})};
  expect_error(ErrorCode::bad_input, "types", "flat faces at top and bottom",
               [&] { StackMaker maker(meshes); });
}

TEST_CASE("what flat polygons have in common, and how far inside a point lies") {
  const FlatPolygon square = hull_of({{0, 0}, {1, 1}, {1, 0}, {0.5, 0.5}, {0, 1}});
  CHECK(square.size() == 4);
  CHECK(area_of(square) == doctest::Approx(1));
  const FlatPolygon shifted = hull_of({{0.5, -1}, {2, -1}, {2, 0.25}, {0.5, 0.25}});
  CHECK(area_of(common_part(square, shifted)) == doctest::Approx(0.125));
  CHECK(common_part(square, hull_of({{2, 2}, {3, 2}, {3, 3}})).empty());
  CHECK(depth_inside(square, {0.5, 0.25}) == doctest::Approx(0.25));
  CHECK(depth_inside(square, {1.5, 0.5}) == doctest::Approx(-0.5));
}

}  // namespace vantage::test
