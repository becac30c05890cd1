#include "metrics/tracking/steadiness.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace vantage::test {
namespace {

using doctest::Approx;

/// Errors along x for instants 0, 1, …
StandingErrors errors_along_x(std::vector<double> metres, int since = 0, std::uint64_t object = 1) {
  StandingErrors errors;
  for (std::size_t i = 0; i < metres.size(); ++i) {
    auto& error = errors[{object, since}][since + int(i)];
    error.setZero();
    error[0] = metres[i];
  }
  return errors;
}

}  // namespace

TEST_CASE("a pose's error is in the world's frame, as its covariance is") {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  const Eigen::Matrix3d truth = Eigen::AngleAxisd(1, Eigen::Vector3d::UnitX()).toRotationMatrix();
  const auto error = pose_error(Pose::from_rotation(turn * truth, {1, 2, 3}),
                                Pose::from_rotation(truth, {1, 2, 2.5}));
  CHECK(error.head<3>().isApprox(Eigen::Vector3d(0, 0, 0.5), 1e-12));
  CHECK(error.tail<3>().isApprox(Eigen::Vector3d(0, 0, 0.1), 1e-9));
}

TEST_CASE("jitter is the standard deviation over time, whatever the mean, after settling") {
  const StandingErrors tracked = errors_along_x({9, 9, 9, 1.01, 0.99, 1.01, 0.99});
  const StandingErrors single = errors_along_x({9, 9, 9, 1.04, 0.96, 1.04, 0.96, 7});
  const ComparedJitter jitter = compare_jitter(tracked, single);
  CHECK(jitter.tracked.jitter().poses == 4);
  CHECK(jitter.tracked.jitter().translation_m == Approx(0.01 * std::sqrt(4.0 / 3)).scale(0));
  CHECK(jitter.single.jitter().translation_m == Approx(0.04 * std::sqrt(4.0 / 3)).scale(0));
  CHECK(jitter.tracked.jitter().rotation_rad == 0);
}

TEST_CASE("lag counts from the instant in which a move is due to the first good pose") {
  TrueEvent move{.kind = SceneEventKind::moved, .object = 1, .type = 0, .begin = 2, .due = 5};
  const Lag late = lag_of(std::vector{move}, errors_along_x({0.01, 0.003, 0.001, 0}, 5));
  CHECK(late.instants == std::vector<int>{2});
  const Lag never = lag_of(std::vector{move}, errors_along_x({0.01, 0.01}, 5));
  CHECK(never.unsettled == 1);
  CHECK(never.instants.empty());
  const Lag other = lag_of(std::vector{move}, errors_along_x({0, 0}, 5, 2));
  CHECK(other.unsettled == 1);
  move.due = 20;  // the standing before the move says nothing
  CHECK(lag_of(std::vector{move}, errors_along_x({0, 0}, 5)).unsettled == 1);
}

}  // namespace vantage::test
