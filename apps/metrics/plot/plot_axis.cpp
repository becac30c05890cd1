#include "metrics/plot/plot_axis.hpp"

#include <algorithm>
#include <cmath>

namespace vantage {
namespace {

constexpr double kLogarithmicFrom = 10;  // times the smallest value
constexpr double kSlack = 1e-9;

/// 10^exponent, as exactly as a literal.
double power_of_ten(int exponent) {
  return exponent < 0 ? 1 / std::pow(10, -exponent) : std::pow(10, exponent);
}

/// The largest of 1, 2, 5 times a power of ten that is not above `value` > 0.
double round_down(double value) {
  const double power = power_of_ten(int(std::floor(std::log10(value) + kSlack)));
  for (const double digit : {5.0, 2.0}) {
    if (digit * power <= value * (1 + kSlack)) return digit * power;
  }
  return power;
}

double round_up(double value) {
  const double below = round_down(value);
  if (below >= value * (1 - kSlack)) return below;
  const double digit = below / power_of_ten(int(std::floor(std::log10(below) + kSlack)));
  return below * (digit > 1.5 && digit < 3 ? 2.5 : 2);
}

}  // namespace

PlotAxis::PlotAxis(const std::vector<double>& values, const std::vector<double>& reach,
                   PlotScale scale) {
  const double least = values.empty() ? 0 : std::ranges::min(values);
  const double most = values.empty() ? 0 : std::ranges::max(values);
  const double top = std::max(most, reach.empty() ? 0 : std::ranges::max(reach));
  logarithmic_ = least > 0 && (scale == PlotScale::logarithmic || most > kLogarithmicFrom * least);
  if (logarithmic_) {
    low_ = round_down(least / 1.5);  // some bars reach below the means
    high_ = round_up(top);
  } else if (top > 0) {
    step_ = round_up(top / 6);
    high_ = step_ * std::ceil(top / step_ - kSlack);
  }
}

double PlotAxis::share(double value) const {
  if (value <= low_) return 0;
  if (!logarithmic_) return (value - low_) / (high_ - low_);
  return std::log(value / low_) / std::log(high_ / low_);
}

std::vector<double> PlotAxis::ticks() const {
  std::vector<double> ticks;
  if (!logarithmic_) {
    for (int i = 0; i * step_ <= high_ * (1 + kSlack); ++i) ticks.push_back(i * step_);
    return ticks;
  }
  const bool is_long = high_ / low_ > 1e3;
  for (double tick = low_; tick <= high_ * (1 + kSlack); tick = round_up(tick * 1.1)) {
    const double decades = std::log10(tick);
    if (!is_long || std::abs(decades - std::round(decades)) < 1e-6) ticks.push_back(tick);
  }
  return ticks;
}

}  // namespace vantage
