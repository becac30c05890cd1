#include "metrics/tracking/track_frame.hpp"

#include <doctest/doctest.h>

#include "metrics/cube_scene.hpp"
#include "metrics/tracking/tracking_scores.hpp"

namespace vantage::test {
namespace {

using doctest::Approx;

Pose at(double x) {
  return Pose::from_translation({x, 0, 0});
}

std::vector<ErrorModel> cube_models(std::size_t count) {
  return std::vector<ErrorModel>(count, error_model(*cube_type("cube")->mesh, {}));
}

}  // namespace

TEST_CASE("similarity falls to nothing at half a diameter") {
  const ErrorModel cube = cube_models(1)[0];
  CHECK(pose_similarity(cube, at(0), at(0)) == Approx(1));
  CHECK(pose_similarity(cube, at(cube.diameter_m / 4), at(0)) == Approx(0.5));
  CHECK(pose_similarity(cube, at(cube.diameter_m * 0.51), at(0)) == 0);
  CHECK(pose_similarity(cube, at(1), at(0)) == 0);
}

TEST_CASE("what is carried is not judged, at its old place, its new one and between") {
  TrackFrame frame;
  frame.truth = {{.id = 1, .type = 0, .T_world_object = at(0)},
                 {.id = 2,
                  .type = 0,
                  .T_world_object = at(0.5),
                  .judged = false,
                  .excused = {at(0.2), at(0.8)}}};
  frame.estimates = {{.id = 5, .type = 0, .T_world_object = at(0.001)},
                     {.id = 6, .type = 0, .T_world_object = at(0.2)},
                     {.id = 7, .type = 0, .T_world_object = at(0.35)}};
  const ComparedFrame compared = compare(frame, cube_models(1));
  CHECK(compared.truth == std::vector<std::uint64_t>{1});
  CHECK(compared.estimates == std::vector<std::uint64_t>{5, 7});  // one excuse for one object
  CHECK(compared.similarity(0, 1) == 0);
}

TEST_CASE("an estimate of another type is near, but not alike") {
  TrackFrame frame;
  frame.truth = {{.id = 1, .type = 0, .T_world_object = at(0)}};
  frame.estimates = {{.id = 5, .type = 1, .T_world_object = at(0)}};
  const ComparedFrame compared = compare(frame, cube_models(2));
  CHECK(compared.similarity(0, 0) == 0);
  CHECK(compared.nearness(0, 0) == Approx(1));
}

TEST_CASE("estimates of neighbouring frames are numbered by the nearest, one to one") {
  std::vector<TrackFrame> frames(3);
  const auto estimates = [](std::vector<double> xs) {
    std::vector<EstimateAt> all;
    for (const double x : xs) all.push_back({.id = 0, .type = 0, .T_world_object = at(x)});
    return all;
  };
  frames[0].estimates = estimates({0, 0.3});
  frames[1].estimates = estimates({0.31, 0.01, 0.02});
  frames[2].estimates = estimates({0.6});
  number_by_nearest(frames, cube_models(1));
  CHECK(frames[0].estimates[0].id == 1);
  CHECK(frames[0].estimates[1].id == 2);
  CHECK(frames[1].estimates[0].id == 2);
  CHECK(frames[1].estimates[1].id == 1);
  CHECK(frames[1].estimates[2].id == 3);
  CHECK(frames[2].estimates[0].id == 4);  // farther than a diameter from all
}

TEST_CASE("a perfect run has perfect scores, and phantoms are counted for each instant") {
  TrackedRun run, single;
  for (int i = 0; i < 6; ++i) {
    TrackFrame frame;
    frame.truth = {{.id = 1, .type = 0, .T_world_object = at(0)}};
    frame.estimates = {{.id = 4, .type = 0, .T_world_object = at(0)}};
    single.frames.push_back(frame);
    if (i >= 3) frame.estimates.push_back({.id = 5, .type = 0, .T_world_object = at(0.7)});
    run.frames.push_back(frame);
  }
  TrackingScores total;
  total.add(tracking_scores(single, single, {}, cube_models(1)));
  CHECK(total.hota.hota == Approx(1));
  CHECK(total.phantoms == 0);
  total.add(tracking_scores(run, single, {}, cube_models(1)));
  CHECK(total.runs == 2);
  CHECK(total.phantoms_per_instant() == Approx(3.0 / 12));
  CHECK(total.hota.detection == Approx((1 + 6.0 / 9) / 2));
  CHECK(total.events.precision() == 1);
}

}  // namespace vantage::test
