#include "evaluation/plot_marks.hpp"

#include <fmt/format.h>

#include <array>

namespace vantage {
namespace {

constexpr double kMark = 4.5;  // half its size

constexpr std::array<PlotStyle, 5> kStyles{{{"#d55e00", "7 4"},
                                            {"#0072b2", "none"},
                                            {"#009e73", "2 3"},
                                            {"#cc79a7", "9 3 2 3"},
                                            {"#555555", "4 2"}}};

}  // namespace

PlotStyle plot_style(std::size_t series) {
  return kStyles[series % kStyles.size()];
}

std::string plot_mark(std::size_t series, double x, double y) {
  const char* color = plot_style(series).color;
  const std::string hollow = fmt::format("fill=\"#fff\" stroke=\"{}\" stroke-width=\"1.8\"", color);
  const std::string full = fmt::format("fill=\"{0}\" stroke=\"{0}\" stroke-width=\"1\"", color);
  const double r = kMark;
  const auto path = [&](const std::string& shape, const std::string& look) {
    return fmt::format("<path transform=\"translate({:.1f} {:.1f})\" d=\"{}\" {}/>\n", x, y, shape,
                       look);
  };
  switch (series % kStyles.size()) {
    case 0:
      return path(fmt::format("M{0} {0}H-{0}V-{0}H{0}Z", r), hollow);
    case 1:
      return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" {}/>\n", x, y, r, full);
    case 2:
      return path(fmt::format("M0 -{0}L{0} {1}H-{0}Z", r + 1, r), hollow);
    case 3:
      return path(fmt::format("M0 -{0}L{0} 0L0 {0}L-{0} 0Z", r + 1), full);
    default:
      return path(fmt::format("M-{0} -{0}L{0} {0}M-{0} {0}L{0} -{0}", r), hollow);
  }
}

}  // namespace vantage
