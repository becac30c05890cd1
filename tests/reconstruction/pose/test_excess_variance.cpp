#include "pose/excess_variance.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>
#include <vector>

namespace vantage::reconstruction::detail {
namespace {

/// Both coordinates of points with noise of different sigmas, and an error that all share.
std::vector<PointResidual> residuals_with(double model_px, std::size_t count) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::vector<PointResidual> residuals;
  for (std::size_t i = 0; i < count; ++i) {
    const double sigma = 0.02 * double(1 + i % 10), spread = std::hypot(sigma, model_px);
    const double u = spread * normal(random), v = spread * normal(random);
    residuals.push_back({u * u + v * v, sigma});
  }
  return residuals;
}

}  // namespace

TEST_CASE("what residuals have beyond their noise is found, and nothing where there is nothing") {
  for (const double model_px : {0.05, 0.2, 1.0}) {
    CAPTURE(model_px);
    const double found = model_error_px(residuals_with(model_px, 5000), 10000);
    CHECK(std::abs(found - model_px) < 0.03 * model_px);
  }
  CHECK(model_error_px(residuals_with(0, 5000), 10000) < 0.01);
  CHECK(model_error_px(std::vector<PointResidual>{{0.01, 0.2}}, 2) == 0);
  CHECK(model_error_px({}, 0) == 0);
}

TEST_CASE("the ratio that chance exceeds once in a thousand") {
  // Quantiles of chi-square from tables; the formula is good to 2 %.
  CHECK(std::abs(3 * unlikely_ratio(3) / 16.266 - 1) < 0.02);
  CHECK(std::abs(10 * unlikely_ratio(10) / 29.588 - 1) < 0.01);
  CHECK(std::abs(100 * unlikely_ratio(100) / 149.449 - 1) < 0.001);
}

}  // namespace vantage::reconstruction::detail
