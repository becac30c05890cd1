// The thesis' figures hang together; a slip in copying them would not.
#include "metrics/planning/thesis_planning.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

struct Sums {
  double rows = 0, ratio = 0, time = 0, quality = 0, production_time = 0;
};

Sums sums_of(std::string_view method) {
  Sums sums;
  for (const ThesisPick& pick : thesis_picks()) {
    if (pick.method != method) continue;
    ++sums.rows;
    sums.ratio += pick.vox_ratio;
    sums.time += pick.run_time_s;
    sums.quality += pick.vox_quality;
    sums.production_time += pick.production_run_time_s;
  }
  return sums;
}

}  // namespace

TEST_CASE("the thesis' averaged results are the means of its rows, as far as it prints them") {
  REQUIRE(thesis_means().size() == 3);
  for (const ThesisMean& mean : thesis_means()) {
    CAPTURE(mean.method);
    const Sums sums = sums_of(mean.method);
    REQUIRE(sums.rows == 4);
    CHECK(std::abs(sums.ratio / 4 - mean.vox_ratio) <= 0.00051);
    CHECK(std::abs(sums.time / 4 - mean.run_time_s) <= 0.051);
    CHECK(std::abs(sums.quality / 4 - mean.vox_quality) <= 0.0051);
    CHECK(std::abs(sums.production_time / 4 - mean.production_run_time_s) <= 0.051);
  }
}

TEST_CASE("the thesis' vox ratios are its vox scores by those of its voxel method") {
  for (const ThesisPick& pick : thesis_picks()) {
    CAPTURE(pick.title);
    CAPTURE(pick.method);
    const ThesisPick* const voxel = thesis_pick(pick.scene, "voxel");
    REQUIRE(voxel != nullptr);
    CHECK(std::abs(pick.vox_score_m3 / voxel->vox_score_m3 - pick.vox_ratio) <= 0.0025);
  }
  for (const ThesisServo& servo : thesis_servos()) {
    CAPTURE(servo.table);
    const double best = thesis_pick(servo.scene, "voxel")->vox_score_m3;
    for (const ThesisStep& step : servo.steps) {
      CHECK(std::abs(step.vox_score_m3 / best - step.vox_ratio) <= 0.0025);
    }
  }
}

TEST_CASE("where the thesis prints both, the servo's best step is the method's row") {
  int both = 0;
  for (const ThesisServo& servo : thesis_servos()) {
    const ThesisPick* const pick = thesis_pick(servo.scene, servo.method);
    if (pick == nullptr) continue;
    ++both;
    const auto best = std::ranges::max_element(servo.steps, {}, &ThesisStep::method_score);
    CHECK(best->method_score == pick->method_score);
    CHECK(best->vox_score_m3 == pick->vox_score_m3);
  }
  CHECK(both == 2);
}

TEST_CASE("what the thesis does not have is null") {
  CHECK(thesis_pick("castle:front", "voxel") == nullptr);
  CHECK(thesis_pick("wall:front", "light") == nullptr);
  CHECK(thesis_mean("light") == nullptr);
  CHECK(thesis_servo("wall:top", "shadowD6") == nullptr);
}

}  // namespace vantage
