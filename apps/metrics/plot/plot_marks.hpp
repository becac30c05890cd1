#pragma once

#include <cstddef>
#include <string>

namespace vantage {

/// How a series of a plot looks. Colours are Okabe and Ito's, which most people can tell apart;
/// they differ in brightness, too. After six series they begin again.
struct PlotStyle {
  const char* color;
  const char* dashes;
};
PlotStyle plot_style(std::size_t series);

enum class MarkFill {
  usual,  ///< some series' marks are full, others hollow
  full,
  hollow,
};

/// Square, disc, triangle, diamond, cross, upturned triangle, plus: told apart without colour. An
/// SVG element.
std::string plot_mark(std::size_t series, double x, double y, MarkFill fill = MarkFill::usual);

}  // namespace vantage
