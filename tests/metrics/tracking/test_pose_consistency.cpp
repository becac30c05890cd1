#include "metrics/tracking/pose_consistency.hpp"

#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "metrics/cube_scene.hpp"
#include "reference/random_scene.hpp"

namespace vantage::test {
namespace {

using doctest::Approx;

double normal(Random& random) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.uniform(0, 1);
  return sum;
}

/// One object, estimated with noise that is `factor` times what the covariance says.
PoseConsistency simulated_consistency(double factor, int runs) {
  const double sigma_m = 0.001, sigma_rad = 0.002;
  Matrix6d covariance = Matrix6d::Zero();
  covariance.diagonal() << Eigen::Vector3d::Constant(sigma_m * sigma_m),
      Eigen::Vector3d::Constant(sigma_rad * sigma_rad);
  const std::vector<ErrorModel> models(1, error_model(*cube_type("cube")->mesh, {}));
  Random random(3);
  PoseConsistency all;
  for (int run = 0; run < runs; ++run) {
    const auto draw = [&](double sigma) -> Eigen::Vector3d {
      return Eigen::Vector3d(normal(random), normal(random), normal(random)) * sigma * factor;
    };
    const Eigen::Vector3d turn = draw(sigma_rad);
    TrackFrame frame;
    frame.truth = {{.id = 1, .type = 0, .T_world_object = {}}};
    frame.estimates = {
        {.id = 1,
         .type = 0,
         .T_world_object = Pose::from_rotation(
             Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix(), draw(sigma_m)),
         .covariance = covariance}};
    const std::vector<TrackFrame> frames(4, frame);
    all.add(pose_consistency(frames, compare(frames, models)));
  }
  return all;
}

}  // namespace

TEST_CASE("quantiles of chi-square are those of the tables") {
  CHECK(chi_square_quantile(0.95, 6) == Approx(12.592).epsilon(0.005));
  CHECK(chi_square_quantile(0.025, 60) == Approx(40.482).epsilon(0.002));
  CHECK(chi_square_quantile(0.975, 60) == Approx(83.298).epsilon(0.002));
}

TEST_CASE("right covariances have a NEES of six, and one sample for each standing") {
  const PoseConsistency right = simulated_consistency(1, 400);
  CHECK(right.nees.size() == 400);
  CHECK(right.mean() > right.low());
  CHECK(right.mean() < right.high());
  CHECK(right.coverage() == Approx(0.95).epsilon(0.03));
}

TEST_CASE("covariances that are too small or too large by a third leave the interval") {
  const PoseConsistency bold = simulated_consistency(1.15, 400),
                        shy = simulated_consistency(0.87, 400);
  CHECK(bold.mean() > bold.high());
  CHECK(shy.mean() < shy.low());
}

}  // namespace vantage::test
