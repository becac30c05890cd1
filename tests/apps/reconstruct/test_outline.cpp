#include "reconstruct/outline.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage::test {
namespace {

const Lens kLens({640, 480, 600, 600, 319.5, 239.5}, {});

struct Lengths {
  double visible = 0, hidden = 0;
};

Lengths lengths_of(const std::vector<OutlinePiece>& pieces) {
  Lengths lengths;
  for (const OutlinePiece& piece : pieces) {
    (piece.visible ? lengths.visible : lengths.hidden) += (piece.to - piece.from).norm();
  }
  return lengths;
}

std::shared_ptr<const Scene> scene_of(const std::vector<TriangleMesh>& meshes) {
  SceneBuilder builder;
  for (const TriangleMesh& mesh : meshes) builder.add_mesh(mesh);
  return builder.build();
}

}  // namespace

TEST_CASE("a box has twelve sharp edges, six diagonals aside, and the camera sees nine of them") {
  const TriangleMesh box = box_solid({0.1, 0.1, 0.1});
  const auto edges = edges_of(box);
  CHECK(edges.size() == 18);
  const Pose T_world_cam = Pose::looking_at({0.5, 0.4, 0.3}, {0, 0, 0});
  const Lengths seen = lengths_of(outline(edges, {}, kLens, T_world_cam, *scene_of({box})));
  // The same by projecting the twelve edges: those that end in the corner farthest away are hidden.
  Lengths expected;
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 4; ++side) {
      Eigen::Vector3d from, to;
      from[axis] = -0.05, to[axis] = 0.05;
      from[(axis + 1) % 3] = to[(axis + 1) % 3] = side % 2 == 0 ? -0.05 : 0.05;
      from[(axis + 2) % 3] = to[(axis + 2) % 3] = side / 2 == 0 ? -0.05 : 0.05;
      const Pose T_cam_world = T_world_cam.inverse();
      const double length =
          (kLens.project(T_cam_world * from) - kLens.project(T_cam_world * to)).norm();
      (side == 0 ? expected.hidden : expected.visible) += length;
    }
  }
  CHECK(std::abs(seen.visible + seen.hidden - expected.visible - expected.hidden) <
        1e-3);  // the mesh has floats
  CHECK(std::abs(seen.hidden - expected.hidden) < 0.05 * expected.hidden);
}

TEST_CASE("a ball's outline is its silhouette") {
  const TriangleMesh ball = sphere_solid(0.05, 128);
  const Pose T_world_cam = Pose::looking_at({0, -0.6, 0}, {0, 0, 0});
  const auto pieces = outline(edges_of(ball), {}, kLens, T_world_cam, *scene_of({ball}));
  REQUIRE(!pieces.empty());
  const double radius = 600 * std::tan(std::asin(0.05 / 0.6));
  for (const OutlinePiece& piece : pieces) {
    CHECK(std::abs((piece.from - Eigen::Vector2d(319.5, 239.5)).norm() - radius) < 1.5);
  }
}

TEST_CASE(
    "what stands behind something else is hidden, and what is behind the camera is not drawn") {
  const TriangleMesh box = box_solid({0.1, 0.1, 0.1});
  const TriangleMesh wall =
      box_solid({1, 0.01, 1}).transformed(Pose::from_translation({0, -0.2, 0}));
  const Pose T_world_cam = Pose::looking_at({0, -0.6, 0.1}, {0, 0, 0});
  const Lengths seen =
      lengths_of(outline(edges_of(box), {}, kLens, T_world_cam, *scene_of({box, wall})));
  CHECK(seen.visible == 0);
  CHECK(seen.hidden > 100);
  const Pose behind = Pose::from_translation({0, -2, 0});
  CHECK(outline(edges_of(box), behind, kLens, T_world_cam, *scene_of({box})).empty());
}

}  // namespace vantage::test
