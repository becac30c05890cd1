#include "metrics/bop/pose_errors.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "metrics/turns.hpp"
#include "reference/plain_pose_errors.hpp"
#include "reference/random_scene.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage {
namespace {

using test::quarter_turns;
using test::turn;

constexpr Intrinsics kCamera{640, 480, 600, 610, 320, 240};

Eigen::Matrix3d matrix_of(const Intrinsics& k) {
  return Eigen::Matrix3d{{k.fx, 0, k.cx}, {0, k.fy, k.cy}, {0, 0, 1}};
}

}  // namespace

TEST_CASE("a shifted object is off by the shift, whatever its shape") {
  const ErrorModel model = error_model(wedge_solid({0.08, 0.05, 0.06}), {});
  const Eigen::Vector3d shift(0.001, -0.002, 0.003);
  const Pose truth = turn(0.7, Eigen::Vector3d(1, 2, 3).normalized(), {0.1, 0.2, 0.9});
  const Pose estimate = Pose::from_translation(shift) * truth;
  CHECK(std::abs(translation_error_m(estimate, truth) - shift.norm()) < 1e-12);
  CHECK(rotation_error_rad(estimate, truth) < 1e-12);
  CHECK(std::abs(add_m(model, estimate, truth) - shift.norm()) < 1e-12);
  CHECK(std::abs(mssd_m(model, estimate, truth) - shift.norm()) < 1e-12);
  CHECK(add_s_m(model, estimate, truth) <= shift.norm() + 1e-12);
  CHECK(std::abs(add_s_m(model, estimate, truth) - shift.norm()) < 1e-12);  // corners are far apart
}

TEST_CASE("a cube after a quarter turn is unchanged if it is symmetric") {
  const TriangleMesh cube = box_solid({0.05, 0.05, 0.05});
  const ErrorModel symmetric = error_model(cube, quarter_turns()), plain = error_model(cube, {});
  const Pose truth = turn(0.3, Eigen::Vector3d::UnitX(), {0, 0, 0.8});
  const Pose estimate = truth * turn(std::numbers::pi / 2, Eigen::Vector3d::UnitZ());
  CHECK(mssd_m(symmetric, estimate, truth) < 1e-9);
  CHECK(mspd_px(symmetric, estimate, truth, kCamera) < 1e-6);
  CHECK(mssd_m(plain, estimate, truth) == doctest::Approx(0.05));  // a corner goes to the next one
  CHECK(add_m(symmetric, estimate, truth) == doctest::Approx(0.05));  // ADD knows no symmetries
  CHECK(add_s_m(plain, estimate, truth) < 1e-9);
  CHECK(rotation_error_rad(estimate, truth) == doctest::Approx(std::numbers::pi / 2));

  const SymmetricTruth nearest = nearest_symmetric(symmetric, estimate, truth);
  CHECK(rotation_error_rad(estimate, nearest.T_ref_object) < 1e-9);
  CHECK(nearest.mssd_m < 1e-9);
}

TEST_CASE("turning a round thing around its axis costs no more than half a step") {
  const ErrorModel tin = error_model(cylinder_solid(0.03, 0.06),
                                     {.discrete = {}, .continuous = {{Eigen::Vector3d::UnitZ()}}});
  for (const double angle : {0.1, 1.0, 3.0, 5.5}) {
    const Pose estimate = turn(angle, Eigen::Vector3d::UnitZ(), {0, 0, 0.5});
    const Pose truth = Pose::from_translation({0, 0, 0.5});
    CHECK(mssd_m(tin, estimate, truth) <= 0.03 * std::numbers::pi / 315 + 1e-9);
  }
}

TEST_CASE("rotation errors near nothing and near half a turn") {
  const Eigen::Vector3d axis = Eigen::Vector3d(3, -1, 2).normalized();
  for (const double angle : {1e-7, 1e-3, 1.0, 3.0, std::numbers::pi - 1e-6}) {
    CAPTURE(angle);
    CHECK(std::abs(rotation_error_rad(turn(angle, axis), Pose()) - angle) < 1e-9);
    CHECK(std::abs(rotation_error_rad(Pose(), turn(-angle, axis)) - angle) < 1e-9);
  }
}

TEST_CASE("a vertex that is not before the camera has no projection") {
  const ErrorModel model = error_model(box_solid({0.05, 0.05, 0.05}), {});
  const Pose before = Pose::from_translation({0, 0, 0.5}), at = Pose::from_translation({0, 0, 0});
  CHECK(std::isinf(mspd_px(model, at, before, kCamera)));
  CHECK(std::isinf(mspd_px(model, before, at, kCamera)));
}

TEST_CASE("pose errors are the slow twin's") {
  for (std::uint32_t seed = 0; seed < test::scene_count(60); ++seed) {
    CAPTURE(seed);
    test::Random random(seed);
    Symmetries symmetries = seed % 2 == 0 ? quarter_turns() : Symmetries{};
    if (seed % 3 == 0) symmetries.continuous.push_back({random.direction(), random.in_cube(0.02)});
    const ErrorModel model = error_model(test::icosphere(0.05, 1), symmetries);
    test::Motions motions;
    for (const Pose& motion : model.symmetries) motions.push_back(test::matrix_of(motion));
    const Pose truth = Pose::from_translation({0, 0, 1}) * random.pose(0.2);
    const Pose estimate = seed % 5 == 0 ? Pose::from_translation({0, 0, 1}) * random.pose(0.2)
                                        : truth * turn(random.uniform(0, 0.2), random.direction(),
                                                       random.in_cube(0.01));
    const Eigen::Matrix4d e = test::matrix_of(estimate), t = test::matrix_of(truth);
    CHECK(std::abs(add_m(model, estimate, truth) - test::plain_add(model.vertices, e, t)) < 1e-12);
    CHECK(std::abs(add_s_m(model, estimate, truth) - test::plain_add_s(model.vertices, e, t)) <
          1e-12);
    CHECK(std::abs(mssd_m(model, estimate, truth) -
                   test::plain_mssd(model.vertices, motions, e, t)) < 1e-12);
    CHECK(std::abs(mspd_px(model, estimate, truth, kCamera) -
                   test::plain_mspd(model.vertices, motions, e, t, matrix_of(kCamera))) < 1e-8);
    CHECK(std::abs(rotation_error_rad(estimate, truth) - test::plain_rotation_error_rad(e, t)) <
          1e-6);
    const SymmetricTruth nearest = nearest_symmetric(model, estimate, truth);
    CHECK(std::abs(nearest.mssd_m - mssd_m(error_model(test::icosphere(0.05, 1), {}), estimate,
                                           nearest.T_ref_object)) < 1e-12);
  }
}

}  // namespace vantage
