#include <doctest/doctest.h>

#include "planner/shared_views.hpp"
#include "planner/small_area.hpp"
#include "support/expect_error.hpp"
#include "vantage/planner/advanced/light_scorer.hpp"
#include "vantage/planner/advanced/make_view_scorer.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

PinholeCamera view_from(const Eigen::Vector3d& eye) {
  return {test::kSmallImage, Pose::looking_at(eye, {0, 0, 0.1}), {0.1, 3}};
}

KnownObject box(const Eigen::Vector3d& min, const Eigen::Vector3d& max) {
  return {"box", std::make_shared<const TriangleMesh>(TriangleMesh::from_box(Box(min, max))), {}};
}

/// A cube of 6 cm that floats in the work area, and a lamp that shines at its +x face alone.
WorldModel lit_cube() {
  WorldModel world;
  world.objects.push_back(box({-0.03, -0.03, 0.07}, {0.03, 0.03, 0.13}));
  world.cameras.push_back({"lamp", view_from({0.8, 0, 0.1}), nullptr});
  return world;
}

struct Lit {
  WorldModel world;
  PlanningScene scene;
  LightScorer scorer;

  Lit(WorldModel w, const Box& area)
      : world(std::move(w)),
        scene(world, classify(world, GridGeometry::covering(area, 0.01)), OccluderMode::mesh),
        scorer(scene, world) {}

  double area_m2(const Eigen::Vector3d& eye) const {
    return double(scorer.ViewScorer::score(view_from(eye)).score) * scorer.unit();
  }
};

}  // namespace

TEST_CASE("the light method sees the faces that no lamp lights, and of the others nothing") {
  const Lit lit(lit_cube(), test::kSmallArea);
  CHECK(lit.scorer.unit() == doctest::Approx(2e-6).epsilon(1e-9));
  CHECK(lit.area_m2({0.8, 0, 0.1}) == 0);
  const double face = 0.06 * 0.06;
  CHECK(std::abs(lit.area_m2({-0.8, 0, 0.1}) - face) < 0.015 * face);
  CHECK(std::abs(lit.area_m2({0, 0.8, 0.1}) - face) < 0.015 * face);
  CHECK(std::abs(lit.area_m2({-0.6, -0.6, 0.7}) - 3 * face) < 0.015 * face);
  CHECK(std::abs(lit.area_m2({0.6, -0.6, 0.7}) - 2 * face) < 0.015 * face);

  const std::vector<ScoreTerm> terms = lit.scorer.terms(view_from({-0.8, 0, 0.1}));
  CHECK(std::abs(terms.at(0).value + terms.at(1).value - 5 * face) < 0.015 * face);
  CHECK(terms.back().value == lit.area_m2({-0.8, 0, 0.1}));
}

TEST_CASE("surfaces count inside the work area alone, and as many samples as can be borne") {
  const double face = 0.06 * 0.06;
  const Lit half(lit_cube(), Box({-0.1, -0.1, 0}, {0.1, 0.1, 0.1}));
  CHECK(std::abs(half.area_m2({-0.8, 0, 0.1}) - 0.5 * face) < 0.015 * face);

  WorldModel large = lit_cube();
  large.static_structures.push_back(box({-20, -20, -0.1}, {20, 20, 0}));
  CHECK(Lit(large, test::kSmallArea).scorer.unit() == doctest::Approx(2e-6).epsilon(1e-9));
  const Lit floor(large, Box({-0.4, -0.4, -0.05}, {0.4, 0.4, 0.35}));
  CHECK(floor.scorer.unit() == doctest::Approx((0.64 + 6 * face) / (1 << 17)).epsilon(1e-6));
}

TEST_CASE("the light method's flaw: unknown objects cast no shadow") {
  WorldModel unknown = lit_cube();
  unknown.objects.clear();
  const Lit dark(unknown, test::kSmallArea);
  CHECK(dark.area_m2({-0.8, 0, 0.1}) == 0);
  CHECK(dark.scorer.upper_bound(view_from({-0.8, 0, 0.1})) == 0);
}

TEST_CASE("a method's scorer has the method's name, and invalid options are refused") {
  WorldModel measured = lit_cube();
  DepthCamera& camera = measured.cameras[0];
  camera.depth =
      std::make_shared<const DepthImage>(known_scene(measured)->render_depth(camera.camera));
  const Lit lit(measured, test::kSmallArea);
  for (const std::string& name : method_names()) {
    CHECK(make_view_scorer(method_named(name), lit.scene, lit.world, {0.1, 3}, StereoNoise())
              ->name() == name);
  }
  test::expect_bad_input("method", "a depth power of -1", [&] {
    make_view_scorer(ShadowMethod{-1}, lit.scene, lit.world, {0.1, 3}, StereoNoise());
  });
}

}  // namespace vantage
