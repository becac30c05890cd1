#pragma once

namespace vantage::reconstruction::detail {

/// Where a function of one number is least between two bounds, if it has one minimum there. Every
/// step looks at one more place and leaves 62 % of what is between the bounds.
template <class Cost>
double least_by_golden_section(double low, double high, int steps, const Cost& cost) {
  constexpr double kInvGolden = 0.6180339887498949;
  double a = high - kInvGolden * (high - low), b = low + kInvGolden * (high - low);
  double cost_a = cost(a), cost_b = cost(b);
  for (int i = 0; i < steps; ++i) {
    if (cost_a < cost_b) {
      high = b, b = a, cost_b = cost_a;
      a = high - kInvGolden * (high - low), cost_a = cost(a);
    } else {
      low = a, a = b, cost_a = cost_b;
      b = low + kInvGolden * (high - low), cost_b = cost(b);
    }
  }
  return 0.5 * (low + high);
}

}  // namespace vantage::reconstruction::detail
