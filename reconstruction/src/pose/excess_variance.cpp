#include "pose/excess_variance.hpp"

#include <cmath>

namespace vantage::reconstruction::detail {
namespace {

constexpr int kHalvings = 40;

double chi_square(std::span<const PointResidual> residuals, double model_px) {
  double sum = 0;
  for (const PointResidual& r : residuals) {
    sum += r.squared_px / (r.sigma_px * r.sigma_px + model_px * model_px);
  }
  return sum;
}

}  // namespace

double unlikely_ratio(double degrees_of_freedom) {
  constexpr double kNormalQuantile = 3.09;
  const double spread = 2.0 / (9.0 * degrees_of_freedom);
  return std::pow(1 - spread + kNormalQuantile * std::sqrt(spread), 3);
}

double model_error_px(std::span<const PointResidual> residuals, double degrees_of_freedom) {
  if (!(degrees_of_freedom > 0) || chi_square(residuals, 0) <= degrees_of_freedom) return 0;
  double squared = 0;
  for (const PointResidual& r : residuals) squared += r.squared_px;
  double low = 0, high = std::sqrt(squared / degrees_of_freedom);  // there it is small enough
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    (chi_square(residuals, middle) > degrees_of_freedom ? low : high) = middle;
  }
  return high;
}

}  // namespace vantage::reconstruction::detail
