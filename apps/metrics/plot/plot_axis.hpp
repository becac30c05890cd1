#pragma once

#include <vector>

namespace vantage {

enum class PlotScale {
  automatic,    ///< logarithmic where values differ by more than ten times and none is zero
  logarithmic,  ///< unless some value is zero
};

/// An axis: from values to shares of its length, 0 at the bottom (or left) and 1 at the other end.
class PlotAxis {
 public:
  /// @param values that have to be on the axis, finite and not negative.
  /// @param reach  the upper ends of their error bars.
  PlotAxis(const std::vector<double>& values, const std::vector<double>& reach,
           PlotScale scale = PlotScale::automatic);

  bool logarithmic() const noexcept { return logarithmic_; }
  double low() const noexcept { return low_; }

  /// Of values below the axis: 0.
  double share(double value) const;

  /// Round values, ascending, for labels: 1, 2 and 5 times powers of ten; of a long logarithmic
  /// axis the powers alone.
  std::vector<double> ticks() const;

 private:
  bool logarithmic_;
  double low_ = 0, high_ = 1, step_ = 0.2;
};

}  // namespace vantage
