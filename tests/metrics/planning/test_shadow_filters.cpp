#include <doctest/doctest.h>

#include "metrics/planning/shadow_filter_evaluation.hpp"
#include "vantage/volume/advanced/carve.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

const Box kArea({0, 0, 0}, {0.12, 0.12, 0.12});
const GridGeometry kGeometry = GridGeometry::covering(kArea, 0.01);  // 1 cm³ a voxel

/// A wall that fills 0.02 < x < 0.03, before a camera that looks along x; it hides all behind it.
StateGrid const& truth_of_wall() {
  static const auto grid = [] {
    const auto wall = std::make_shared<const TriangleMesh>(
        TriangleMesh::from_box(Box({0.02, -1, -1}, {0.03, 1, 1})));
    const PinholeCamera camera({200, 200, 100, 100, 99.5, 99.5},
                               Pose::looking_at({-0.5, 0.06, 0.06}, {0, 0.06, 0.06}));
    return classify({{}, {{"wall", wall, {}}}, {{"camera", camera, nullptr}}}, kGeometry);
  }();
  return *grid;
}

/// Everything beyond depth `x` from the camera's plane is shadow.
std::shared_ptr<const StateGrid> shadow_behind(double x) {
  const PinholeCamera camera({200, 200, 100, 100, 99.5, 99.5},
                             Pose::looking_at({-0.5, 0.06, 0.06}, {0, 0.06, 0.06}));
  const float depth = float(0.5 + x);
  const std::vector<VisibilityMesh> lattices{
      {camera, {0, 199}, {0, 199}, {depth, depth, depth, depth}}};
  return carve(lattices, kGeometry, {});
}

ShadowScore score_of(double m3_true, double m3_false, double m3_missed) {
  return {m3_true, m3_false, m3_missed, 0};
}

}  // namespace

TEST_CASE("shadow is scored against the truth: solid and boundary voxels count for nothing") {
  REQUIRE(truth_of_wall().count(VoxelState::occupied) == 144);
  REQUIRE(truth_of_wall().count(VoxelState::shadow) == 9 * 144);
  const TrueShadow truth(truth_of_wall());
  // The wall's layer x = 2 is solid, layer 1 touches it; layers 3 to 11 are hidden.
  const ShadowScore exact = truth.score(*shadow_behind(0.03));
  CHECK(exact.true_m3 == doctest::Approx(9 * 144e-6));
  CHECK(exact.false_m3 == 0);
  CHECK(exact.missed_m3 == 0);
  CHECK(exact.f1() == 1);
  const ShadowScore all = truth.score(*shadow_behind(-0.01));
  CHECK(all.true_m3 == doctest::Approx(9 * 144e-6));
  CHECK(all.false_m3 == doctest::Approx(144e-6));     // layer 0
  CHECK(all.boundary_m3 == doctest::Approx(144e-6));  // layer 1
  CHECK(*all.precision() == doctest::Approx(0.9));
  CHECK(all.recall() == 1);
  const ShadowScore part = truth.score(*shadow_behind(0.06));
  CHECK(part.missed_m3 == doctest::Approx(3 * 144e-6));
  CHECK(*part.recall() == doctest::Approx(6.0 / 9));
}

TEST_CASE("precision, recall and F1 are empty where they are undefined") {
  CHECK_FALSE(score_of(0, 0, 1).precision());
  CHECK_FALSE(score_of(0, 1, 0).recall());
  CHECK_FALSE(score_of(0, 0, 1).f1());
  CHECK(score_of(0, 1, 1).f1() == 0);
  CHECK(*score_of(3, 1, 2).f1() == doctest::Approx(2 * 0.75 * 0.6 / (0.75 + 0.6)));
}

TEST_CASE("the best filter has the largest mean F1 over the scenes that have one") {
  ShadowFilterEvaluation evaluation{0.01, {{}, {3, 0, 0}, {3, 2, 0}}, {}};
  CHECK_FALSE(best_filter(evaluation));
  evaluation.scenes = {
      {"a", 4e-6, {score_of(4e-6, 4e-6, 0), score_of(4e-6, 0, 0), score_of(3e-6, 0, 1e-6)}},
      {"b", 4e-6, {score_of(4e-6, 4e-6, 0), score_of(4e-6, 1e-6, 0), score_of(4e-6, 0, 0)}},
      {"nothing is hidden", 0, {score_of(0, 0, 0), score_of(0, 0, 0), score_of(0, 0, 0)}}};
  CHECK(best_filter(evaluation) == 1);
  const FilterMeans means = means_of(evaluation, 1);
  CHECK(*means.precision == doctest::Approx(0.9));
  CHECK(means.recall == 1);
  CHECK(means.false_m3 == doctest::Approx(1e-6 / 3));
  const std::vector<ReportTable> tables = shadow_filter_tables(evaluation);
  REQUIRE(tables.size() == 2);
  REQUIRE(tables[0].rows.size() == 3);
  CHECK(tables[0].rows[1].kind == RowKind::emphasis);
  CHECK(tables[0].rows[1].cells ==
        std::vector<std::string>{"3", "0", "0.0", "90.0 %", "100.0 %", "94.4 %", "0.3", "0.0"});
  CHECK(tables[1].rows.size() == 9);
}

}  // namespace vantage
