#include "metrics/reconstruction/touching_corners.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>

#include "reference/random_scene.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage {
namespace {

ErrorModel cube() {
  return error_model(box_solid({0.05, 0.05, 0.05}), {});
}

/// The thesis' castle: three cubes in a row, one before the middle one, one on top of it.
std::vector<PlacedModel> castle(const ErrorModel& model, const Pose& T_world_castle = {}) {
  std::vector<PlacedModel> cubes;
  for (const Eigen::Vector3d& at : {Eigen::Vector3d(-0.05, 0, 0.025),
                                    {0, 0, 0.025},
                                    {0.05, 0, 0.025},
                                    {0, -0.05, 0.025},
                                    {0, 0, 0.075}}) {
    cubes.push_back({&model, T_world_castle * Pose::from_translation(at)});
  }
  return cubes;
}

std::vector<Pose> poses_of(const std::vector<PlacedModel>& objects) {
  std::vector<Pose> poses;
  for (const PlacedModel& object : objects) poses.push_back(object.T_world_object);
  return poses;
}

}  // namespace

TEST_CASE("castle: four cubes share a side with the middle one, others an edge with each other") {
  const ErrorModel model = cube();
  const auto pairs = touching_corners(castle(model));
  CHECK(pairs.size() == 4 * 4 + 5 * 2);  // the red one and the purple one: two corners, as printed
  test::Random random(1);
  CHECK(touching_corners(castle(model, random.pose(1))).size() == 26);
}

TEST_CASE("the error of the truth is zero, and that of a shifted cube its corners' shifts") {
  const ErrorModel model = cube();
  const auto cubes = castle(model);
  const auto pairs = touching_corners(cubes);
  std::vector<Pose> poses = poses_of(cubes);
  CHECK(self_consistency_mm2(pairs, poses) < 1e-6);  // vertices are floats
  poses[3] = Pose::from_translation({0, -0.002, 0}) * poses[3];
  // Eight pairs with the yellow cube: four with the green one, two each with red, blue and purple.
  CHECK(self_consistency_mm2(pairs, poses) == doctest::Approx((4 + 3 * 2) * 4.0).epsilon(1e-3));
}

TEST_CASE("moving everything together leaves the scene as consistent as it was") {
  const ErrorModel model = cube();
  const auto cubes = castle(model);
  const auto pairs = touching_corners(cubes);
  std::vector<Pose> poses = poses_of(cubes);
  test::Random random(2);
  for (Pose& pose : poses) pose = pose * Pose::from_translation(random.in_cube(0.003));
  const double before = self_consistency_mm2(pairs, poses);
  const Pose motion = random.pose(1);
  for (Pose& pose : poses) pose = motion * pose;
  CHECK(before > 1);
  CHECK(self_consistency_mm2(pairs, poses) == doctest::Approx(before).epsilon(1e-9));
}

TEST_CASE(
    "a corner with several vertices counts once, and corners that nearly touch do not count") {
  const TriangleMesh mesh = box_solid({0.05, 0.05, 0.05});
  std::vector<Eigen::Vector3f> vertices;  // every triangle with corners of its own
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 0; i < mesh.triangles().size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) vertices.push_back(mesh.corner(i, corner));
    triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const ErrorModel split = error_model(TriangleMesh(vertices, triangles), {});
  REQUIRE(split.vertices.size() == 36);
  const ErrorModel whole = cube();
  const auto beside = [&](double gap_m) {
    return touching_corners(
        std::array{PlacedModel{&split, {}},
                   PlacedModel{&whole, Pose::from_translation({0.05 + gap_m, 0, 0})}});
  };
  CHECK(beside(0).size() == 4);
  CHECK(beside(0.00009).size() == 4);
  CHECK(beside(0.00012).empty());
}

}  // namespace vantage
