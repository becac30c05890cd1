#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace vantage {

/// A pick: how long the method took, and how good it is.
struct TimePlotPoint {
  std::size_t scene = 0;  ///< index
  double run_time_s = 0;  ///< above 0
  double vox_ratio = 0;
};

/// A method's picks, one for each scene or fewer.
struct TimePlotSeries {
  std::string name;
  std::vector<TimePlotPoint> points;
  std::vector<TimePlotPoint> thesis{};  ///< what the thesis printed of the same
};

/// Run time on the horizontal axis, logarithmic, against the vox ratio, as the thesis' figures 9.16
/// and 9.18: one mark for each method and scene, the thesis' marks hollow, with the scene's number
/// beside it. Marks that would cover others stand above them, on a line from their place.
/// @returns a self-contained SVG.
std::string run_time_plot_svg(const std::string& title, const std::vector<std::string>& scenes,
                              const std::vector<TimePlotSeries>& series);

}  // namespace vantage
