#include "metrics/plot/plot_marks.hpp"

#include <fmt/format.h>

#include <array>
#include <numbers>

namespace vantage {
namespace {

constexpr double kMark = 4.5;  // half its size
constexpr double kArm = 2;     // half the width of a cross' arms, which have to have an inside

constexpr std::array<PlotStyle, 7> kStyles{{{"#d55e00", "7 4"},
                                            {"#0072b2", "none"},
                                            {"#009e73", "2 3"},
                                            {"#cc79a7", "9 3 2 3"},
                                            {"#555555", "4 2"},
                                            {"#b8860b", "1 3"},
                                            {"#1b6d85", "5 2 1 2"}}};
constexpr std::array<bool, 7> kFull{false, true, false, true, false, true, false};

std::string shape_of(std::size_t series) {
  const double r = kMark;
  switch (series % kStyles.size()) {
    case 0:
      return fmt::format("M{0} {0}H-{0}V-{0}H{0}Z", r);
    case 1:
      return fmt::format("M-{0} 0A{0} {0} 0 1 0 {0} 0A{0} {0} 0 1 0 -{0} 0Z", r);
    case 2:
      return fmt::format("M0 -{0}L{0} {1}H-{0}Z", r + 1, r);
    case 3:
      return fmt::format("M0 -{0}L{0} 0L0 {0}L-{0} 0Z", r + 1);
    case 4: {
      const double notch = kArm * std::numbers::sqrt2, tip = r + 1;
      return fmt::format(
          "M0 -{0:.2f}L{1:.2f} -{2}L{2} -{1:.2f}L{0:.2f} 0L{2} {1:.2f}L{1:.2f} {2}L0 {0:.2f}"
          "L-{1:.2f} {2}L-{2} {1:.2f}L-{0:.2f} 0L-{2} -{1:.2f}L-{1:.2f} -{2}Z",
          notch, tip - notch, tip);
    }
    case 6:
      return fmt::format("M-{1} -{0}H{1}V-{1}H{0}V{1}H{1}V{0}H-{1}V{1}H-{0}V-{1}H-{1}Z", r + 1.5,
                         kArm);
    default:
      return fmt::format("M0 {0}L{0} -{1}H-{0}Z", r + 1, r);
  }
}

}  // namespace

PlotStyle plot_style(std::size_t series) {
  return kStyles[series % kStyles.size()];
}

std::string plot_mark(std::size_t series, double x, double y, MarkFill fill) {
  const char* const color = plot_style(series).color;
  const bool full = fill == MarkFill::usual ? kFull[series % kFull.size()] : fill == MarkFill::full;
  return fmt::format(
      "<path class=\"mark\" transform=\"translate({:.1f} {:.1f})\" d=\"{}\" fill=\"{}\" "
      "stroke=\"{}\" stroke-width=\"{}\"/>\n",
      x, y, shape_of(series), full ? color : "#fff", color, full ? 1.0 : 1.8);
}

}  // namespace vantage
