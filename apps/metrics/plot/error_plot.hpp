#pragma once

#include <string>
#include <vector>

namespace vantage {

/// Mean and standard deviation at a whole number on the horizontal axis.
struct PlotPoint {
  int x = 0;
  double mean = 0;
  double deviation = 0;
};

/// One line of a panel.
struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;  ///< ascending by x
};

/// One diagram.
struct PlotPanel {
  std::string title;
  std::string unit;
  std::vector<PlotSeries> series;
};

/// Panels side by side, with one legend: means as marks joined by lines, standard deviations as
/// bars, as in the thesis' figure 8.2. Series differ in colour, mark and dashes, so that the plot
/// can be read in black and white. The vertical axes are logarithmic where values need it. A bar
/// that would leave the axis below is a short arrow.
/// @param title, x_label, and all other texts may have any characters.
/// @returns a self-contained SVG; series of all panels with the same index look alike.
std::string error_plot_svg(const std::string& title, const std::string& x_label,
                           const std::vector<PlotPanel>& panels);

}  // namespace vantage
