#include "metrics/tracking/event_scores.hpp"

#include <doctest/doctest.h>

#include "metrics/cube_scene.hpp"

namespace vantage::test {
namespace {

using doctest::Approx;

Pose event_pose(double x) {
  return Pose::from_translation({x, 0, 0});
}

const TrueEvent kMove{.kind = SceneEventKind::moved,
                      .object = 1,
                      .type = 0,
                      .begin = 10,
                      .due = 14,
                      .from = event_pose(0),
                      .to = event_pose(0.3)};

EventScores scores_of(std::vector<ReportedEvent> reports) {
  const std::vector<ErrorModel> models(2, error_model(*cube_type("cube")->mesh, {}));
  return event_scores(std::vector{kMove}, reports, models);
}

ReportedEvent report_at(int instant) {
  return {.kind = SceneEventKind::moved,
          .type = 0,
          .instant = instant,
          .from = event_pose(0.001),
          .to = event_pose(0.302)};
}

}  // namespace

TEST_CASE("a move that is reported in time is found, with its delay") {
  const EventScores scores = scores_of({report_at(16)});
  CHECK(scores.recall() == 1);
  CHECK(scores.precision() == 1);
  CHECK(scores.delays == std::vector<int>{2});
  CHECK(scores.moves_found == 1);
  CHECK(scores_of({report_at(12)}).delays == std::vector<int>{0});  // seen in the air
}

TEST_CASE("a report is false if it is early, late, elsewhere, or of another kind or type") {
  CHECK(scores_of({report_at(9)}).found == 0);
  CHECK(scores_of({report_at(17)}).found == 1);
  CHECK(scores_of({report_at(18)}).found == 0);
  ReportedEvent report = report_at(15);
  report.to = event_pose(0.4);
  CHECK(scores_of({report}).found == 0);
  report = report_at(15), report.from = event_pose(0.1);
  CHECK(scores_of({report}).found == 0);
  report = report_at(15), report.from.reset();
  CHECK(scores_of({report}).found == 0);
  report = report_at(15), report.kind = SceneEventKind::appeared;
  CHECK(scores_of({report}).found == 0);
  report = report_at(15), report.type = 1;
  CHECK(scores_of({report}).found == 0);
}

TEST_CASE("what is reported twice is a false report once") {
  EventScores scores = scores_of({report_at(14), report_at(15)});
  CHECK(scores.recall() == 1);
  CHECK(scores.precision() == Approx(0.5));
  scores.add(scores_of({}));
  CHECK(scores.recall() == Approx(0.5));
  CHECK(scores.moves == 2);
}

}  // namespace vantage::test
