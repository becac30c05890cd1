#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "planner/fake_scorer.hpp"
#include "planner/shadow_views.hpp"
#include "planner/small_area.hpp"
#include "planner/wall_world.hpp"
#include "reference/plain_polish.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/planner/advanced/make_view_scorer.hpp"
#include "vantage/planner/advanced/view_polisher.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

const Eigen::Vector3d kMiddle(0.05, -0.02, 0.1);
const PinholeCamera kCamera({160, 120, 150, 150, 79.5, 59.5}, Pose(), {0.05, 3});
constexpr double kDegree = std::numbers::pi / 180;

/// Scores that grow towards one pose, as smooth as doubles are.
class HillScorer final : public ViewScorer {
 public:
  HillScorer(const Eigen::Vector3d& eye, const Eigen::Vector3d& forward)
      : eye_(eye), forward_(forward) {}

  std::string_view name() const noexcept override { return "hill"; }
  double unit() const noexcept override { return 1; }
  std::string_view unit_name() const noexcept override { return ""; }
  using ViewScorer::score;
  Score height(const Pose& pose) const {
    const double off = (pose.translation() - eye_).squaredNorm() +
                       0.5 * (pose.rotation().col(2) - forward_).squaredNorm();
    return Score(1e12 * std::exp(-off));
  }
  Score upper_bound(const PinholeCamera& view) const override { return height(view.T_world_cam()); }
  void score(std::span<const PinholeCamera> views, std::span<const Score>,
             std::span<ScoreBound> results, const StopToken& stop) const override {
    for (std::size_t i = 0; i < views.size(); ++i) {
      results[i] = stop.stop_requested()
                       ? ScoreBound{}
                       : ScoreBound{ScoreBound::Known::exact, height(views[i].T_world_cam())};
    }
  }
  std::vector<ScoreTerm> terms(const PinholeCamera&) const override { return {}; }

 private:
  Eigen::Vector3d eye_, forward_;
};

std::shared_ptr<const ViewValidityChecker> free_space(const ViewConstraints& constraints = {}) {
  const PlanningScene empty({}, classify({}, GridGeometry::covering(test::kSmallArea, 0.05)),
                            OccluderMode::mesh);
  return std::make_shared<const ViewValidityChecker>(constraints, empty, kCamera.range());
}

/// Checks what has to be true of each step by itself.
/// @param worth of a pose; 0 if it cannot be.
template <class Worth>
void expect_better_and_better(const Pose& start, const std::vector<PolishStep>& steps,
                              const Eigen::Vector3d& middle, const Worth& worth) {
  Score best = worth(start);
  const double distance_m = (start.translation() - middle).norm();
  for (const PolishStep& step : steps) {
    const Score now = worth(step.T_world_cam);
    CHECK(now > best);
    best = now;
    CHECK(std::abs((step.T_world_cam.translation() - middle).norm() - distance_m) < 1e-9);
  }
}

test::PolishAngles angles_of(const std::vector<PolishStep>& steps) {
  test::PolishAngles angles{};
  for (const PolishStep& step : steps) angles[std::size_t(step.move)] += step.by_rad;
  return angles;
}

/// Checks that no smallest step leads to a pose that is worth more.
template <class Worth>
void expect_nothing_better_around(const Pose& start, const std::vector<PolishStep>& steps,
                                  const Eigen::Vector3d& middle, const Worth& worth) {
  const test::PolishAngles end = angles_of(steps);
  const Score best = worth(steps.empty() ? start : steps.back().T_world_cam);
  for (std::size_t move = 0; move < 4; ++move) {
    for (const double sign : {1.0, -1.0}) {
      test::PolishAngles next = end;
      next[move] += sign * (move < 2 ? 5 : 1.5) * kDegree;
      const auto pose = test::plain_polished_pose(start, middle, next);
      // A pixel at the border of something may fall to either side of it.
      if (pose) CHECK(double(worth(*pose)) <= double(best) * (1 + 1e-3));
    }
  }
}

}  // namespace

TEST_CASE("polishing climbs as its slow twin does, step by step") {
  test::Random random(7);
  std::size_t steps = 0;
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    Eigen::Vector3d direction = random.direction(), goal = random.direction();
    direction.z() = std::abs(direction.z()), goal.z() = std::abs(goal.z());
    const double distance_m = random.uniform(0.2, 1);
    if (i % 10 == 0) direction = Eigen::Vector3d::UnitZ();
    const Pose start =
        Pose::looking_at(kMiddle + distance_m * direction, kMiddle + random.in_cube(0.1));
    const auto hill = std::make_shared<const HillScorer>(
        kMiddle + distance_m * goal, (-goal + random.in_cube(0.2)).normalized());
    ViewConstraints constraints;
    if (i % 3 == 0) constraints.reach = Reach{kMiddle + distance_m * direction, 0, 0.3};
    const auto validity = free_space(constraints);
    const ViewPolisher polisher(hill, validity, kCamera, kMiddle, {});
    const auto worth = [&](const Pose& pose) {
      return validity->check(pose) == InvalidReason::none ? hill->height(pose) : 0;
    };
    const std::vector<PolishStep> path = polisher.path(start);
    const auto plain = test::plain_polish(start, kMiddle, worth);
    REQUIRE(path.size() == plain.size());
    for (std::size_t s = 0; s < path.size(); ++s) {
      CHECK(int(path[s].move) == plain[s].first);
      CHECK(path[s].by_rad == doctest::Approx(plain[s].second));
    }
    expect_better_and_better(start, path, kMiddle, worth);
    expect_nothing_better_around(start, path, kMiddle, worth);
    steps += path.size();
  }
  CHECK(steps > 300);
}

TEST_CASE("each move does what its name says") {
  const Pose start = Pose::looking_at(kMiddle + Eigen::Vector3d(0, -0.6, 0.3), kMiddle);
  const auto moved = [&](std::size_t move, double degrees) {
    test::PolishAngles angles{};
    angles[move] = degrees * kDegree;
    return test::plain_polished_pose(start, kMiddle, angles).value();
  };
  const auto first_move = [&](const Pose& goal) {
    const auto hill =
        std::make_shared<const HillScorer>(goal.translation(), goal.rotation().col(2));
    const auto path = ViewPolisher(hill, free_space(), kCamera, kMiddle, {}).path(start);
    REQUIRE(!path.empty());
    CHECK((path.back().T_world_cam.translation() - goal.translation()).norm() < 1e-9);
    return path.front();
  };
  const PolishStep around = first_move(moved(0, 20));
  CHECK(around.move == PolishMove::around);
  CHECK(around.T_world_cam.translation().x() > start.translation().x());  // counterclockwise
  const PolishStep over = first_move(moved(1, 20));
  CHECK(over.move == PolishMove::over);
  CHECK(over.T_world_cam.translation().z() > start.translation().z());
  const PinholeCamera view = kCamera.moved_to(start);
  const PolishStep pan = first_move(moved(2, 6)), tilt = first_move(moved(3, 6));
  CHECK(pan.move == PolishMove::pan);
  CHECK(view.project(pan.T_world_cam * Eigen::Vector3d(0, 0, 1))->u > 90);  // right of the middle
  CHECK(tilt.move == PolishMove::tilt);
  CHECK(view.project(tilt.T_world_cam * Eigen::Vector3d(0, 0, 1))->v < 50);  // above it
}

TEST_CASE("on random workcells every step is feasible and better, and the end a local best") {
  std::size_t steps = 0;
  for (std::uint32_t seed = 0; seed < test::scene_count(8); ++seed) {
    const WorldModel world = test::random_workcell(seed);
    const PlanningScene scene = test::shadow_scene(seed);
    test::Random random(seed);
    const PinholeCamera camera = test::shadow_view_outside(random, 160, 120);
    ViewConstraints constraints;
    if (seed % 2 == 1) constraints.reach = Reach{camera.centre(), 0, 0.4};
    const auto validity =
        std::make_shared<const ViewValidityChecker>(constraints, scene, camera.range());
    const Eigen::Vector3d middle = scene.middle_of_shadow();
    for (const char* method : {"voxel", "shadow", "light"}) {
      CAPTURE(seed);
      CAPTURE(method);
      const std::shared_ptr<const ViewScorer> scorer =
          make_view_scorer(method_named(method), scene, world, camera.range(), StereoNoise());
      const auto worth = [&](const Pose& pose) {
        if (validity->check(pose) != InvalidReason::none) return Score(0);
        return scorer->score(camera.moved_to(pose)).score;
      };
      if (worth(camera.T_world_cam()) == 0) continue;
      const std::vector<PolishStep> path =
          ViewPolisher(scorer, validity, camera, middle, {}).path(camera.T_world_cam());
      expect_better_and_better(camera.T_world_cam(), path, middle, worth);
      expect_nothing_better_around(camera.T_world_cam(), path, middle, worth);
      steps += path.size();
    }
  }
  CHECK(steps > test::enough(40));
}

TEST_CASE("a high travel cost ends polishing earlier") {
  const Pose start = Pose::looking_at(kMiddle + Eigen::Vector3d(0, -0.6, 0.3), kMiddle);
  const Eigen::Vector3d goal = kMiddle + Eigen::Vector3d(0.6, 0, 0.3);
  const auto hill = std::make_shared<const HillScorer>(goal, (kMiddle - goal).normalized());
  const auto end = [&](double weight_per_m) {
    const ViewPolisher polisher(hill, free_space(), kCamera, kMiddle, {},
                                TravelCost{weight_per_m, start.translation()});
    const auto path = polisher.path(start);
    return path.empty() ? start.translation() : path.back().T_world_cam.translation();
  };
  CHECK((end(0) - goal).norm() < 0.1);
  CHECK((end(2) - start.translation()).norm() < 0.8 * (end(0) - start.translation()).norm());
  CHECK((end(100) - start.translation()).norm() < 1e-9);
}

TEST_CASE("polishing ends when it is stopped, and where nothing is better") {
  const Pose start = Pose::looking_at(kMiddle + Eigen::Vector3d(0, -0.6, 0.3), kMiddle);
  const auto flat = std::make_shared<const test::FakeScorer>(1, 0, 0);  // 0 everywhere
  CHECK(ViewPolisher(flat, free_space(), kCamera, kMiddle, {}).path(start).empty());
  const auto hill = std::make_shared<const HillScorer>(kMiddle + Eigen::Vector3d(0.6, 0, 0.3),
                                                       Eigen::Vector3d(-1, 0, 0));
  const ViewPolisher polisher(hill, free_space(), kCamera, kMiddle, {});
  CHECK(!polisher.path(start).empty());
  const StopToken cancelled;
  cancelled.cancel();
  CHECK(polisher.path(start, cancelled).empty());
  CHECK(polisher.path(Pose::from_translation(kMiddle)).empty());  // around what?
}

TEST_CASE("polishing refuses options that make no sense") {
  test::expect_bad_input("polish", "-1 views", [] { PolishOptions{-1, 160}.check(); });
  test::expect_bad_input("polish", "1001 views", [] { PolishOptions{1001, 160}.check(); });
  test::expect_bad_input("polish", "15 pixels", [] { PolishOptions{2, 15}.check(); });
  test::expect_bad_input("polish", "16385", [] { PolishOptions{2, 16385}.check(); });
  const auto flat = std::make_shared<const test::FakeScorer>(1, 0, 0);
  test::expect_bad_input("travel", "weight -1", [&] {
    ViewPolisher(flat, free_space(), kCamera, kMiddle, {}, TravelCost{-1, {0, 0, 0}});
  });
}

}  // namespace vantage
