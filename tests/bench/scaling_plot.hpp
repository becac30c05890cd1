#pragma once

#include <string>
#include <vector>

namespace vantage::bench {

/// Times over a size, in ascending order, both above 0.
struct ScalingSeries {
  std::string name;
  std::vector<double> size, seconds;

  /// How time grows with the larger sizes: the slope of the straight line that fits the logarithms
  /// of the last few points best. 1: as the size does.
  double exponent() const;
};

struct ScalingPanel {
  std::string title, x_label;
  std::vector<ScalingSeries> series;
};

/// Panels side by side, both axes logarithmic, with each series' exponent in the legend below.
/// @returns a self-contained SVG.
std::string scaling_plot_svg(const std::string& title, const std::vector<ScalingPanel>& panels);

}  // namespace vantage::bench
