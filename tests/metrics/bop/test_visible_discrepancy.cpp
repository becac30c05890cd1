#include "metrics/bop/visible_discrepancy.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "reference/plain_pose_errors.hpp"
#include "reference/random_scene.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/raycore/solids.hpp"

namespace vantage {
namespace {

constexpr Intrinsics kSmallCamera{64, 48, 60, 60, 31.5, 23.5};

DepthImage flat(float metres) {
  return DepthImage(64, 48, std::vector<float>(64 * 48, metres));
}

std::vector<double> vsd_of(const TriangleMesh& mesh, const Pose& estimate, const Pose& truth,
                           const DepthImage& scene, double diameter_m) {
  return vsd(view_of(mesh, estimate, kSmallCamera), view_of(mesh, truth, kSmallCamera), scene,
             kSmallCamera, diameter_m);
}

}  // namespace

TEST_CASE("BOP's thresholds") {
  const auto thresholds = bop_thresholds();
  REQUIRE(thresholds.size() == 10);
  CHECK(thresholds.front() == doctest::Approx(0.05));
  CHECK(thresholds.back() == doctest::Approx(0.5));
}

TEST_CASE("the surface of a box before the camera: all of it misaligned beyond its shift's tau") {
  const TriangleMesh box = box_solid({0.2, 0.2, 0.1});
  const Pose truth = Pose::from_translation({0, 0, 1.05}),
             nearer = Pose::from_translation({0, 0, 1.04});
  const auto same = vsd_of(box, truth, truth, flat(2), 0.3);
  for (const double error : same) CHECK(error == 0);

  // Its face is 0.2 m wide at 1 m: 12 pixels; 1 cm nearer it covers the same ones and no more. It
  // is off by 10 mm along the axis, 10.2 mm along the rays of its corners: 3.4 % of 0.3 m.
  for (const double error : vsd_of(box, nearer, truth, flat(2), 0.3)) CHECK(error == 0);
  const auto small = vsd_of(box, nearer, truth, flat(2), 0.05);  // 20 % of 0.05 m
  CHECK(small[2] == 1);                                          // tau 0.15
  CHECK(small[4] == 0);                                          // tau 0.25
}

TEST_CASE("an object beside its place shares nothing with it") {
  const TriangleMesh box = box_solid({0.1, 0.1, 0.1});
  const auto errors = vsd_of(box, Pose::from_translation({0.3, 0, 1}),
                             Pose::from_translation({-0.3, 0, 1}), flat(0), 0.17);
  for (const double error : errors) CHECK(error == 1);
}

TEST_CASE("what stands before an object hides it, and 15 mm do not") {
  const TriangleMesh box = box_solid({0.2, 0.2, 0.1});
  const ObjectView view = view_of(box, Pose::from_translation({0, 0, 1.05}), kSmallCamera);
  CHECK(visible_fraction(view, flat(0.5), kSmallCamera, 0.015) == 0);
  CHECK(visible_fraction(view, flat(0.99f), kSmallCamera, 0.015) == 1);
  CHECK(visible_fraction(view, flat(2), kSmallCamera, 0.015) == 1);
  CHECK(visible_fraction(view, flat(0), kSmallCamera, 0.015) == 1);  // unknown depth hides nothing
  const ObjectView outside = view_of(box, Pose::from_translation({9, 0, 1}), kSmallCamera);
  CHECK(visible_fraction(outside, flat(2), kSmallCamera, 0.015) == 0);
  const Pose truth = Pose::from_translation({0, 0, 1.05});
  for (const double error : vsd_of(box, truth, truth, flat(0.5), 0.3)) CHECK(error == 1);
}

TEST_CASE("VSD is the slow twin's") {
  for (std::uint32_t seed = 0; seed < test::scene_count(8); ++seed) {
    CAPTURE(seed);
    test::Random random(seed);
    const TriangleMesh mesh = wedge_solid({0.3, 0.2, 0.25});
    const Pose truth = Pose::from_translation({0, 0, 1}) * random.pose(0.1);
    const Pose estimate = truth * Pose::from_translation(random.in_cube(0.05));
    std::vector<float> depth;  // a wall with steps and holes, partly before the object
    for (int i = 0; i < 64 * 48; ++i) {
      const double u = random.uniform(0, 1);
      depth.push_back(u < 0.1 ? 0.0f : float(u < 0.3 ? 0.7 : 1.0 + 0.2 * (i % 64) / 64));
    }
    const auto errors = vsd_of(mesh, estimate, truth, DepthImage(64, 48, depth), 0.44);
    for (std::size_t i = 0; i < errors.size(); ++i) {
      const double plain = test::plain_vsd(mesh, estimate, truth, depth, kSmallCamera, 0.44, 0.015,
                                           bop_thresholds()[i]);
      // A pixel at the silhouette or at a threshold may fall to either side, in float or double.
      CHECK(std::abs(errors[i] - plain) < 0.02);
    }
  }
}

TEST_CASE("a scene's depth has to be of the camera's size") {
  const ObjectView view =
      view_of(box_solid({1, 1, 1}), Pose::from_translation({0, 0, 3}), kSmallCamera);
  test::expect_bad_input("scene depth", "it has 2 x 3 pixels; expected 64 x 48",
                         [&] { vsd(view, view, DepthImage(2, 3), kSmallCamera, 1); });
}

}  // namespace vantage
