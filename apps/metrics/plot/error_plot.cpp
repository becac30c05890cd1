#include "metrics/plot/error_plot.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "metrics/plot/plot_axis.hpp"
#include "metrics/plot/plot_marks.hpp"
#include "metrics/plot/svg.hpp"

namespace vantage {
namespace {

constexpr double kPanelWidth = 300, kPanelHeight = 300;  // of the axes' frame
constexpr double kPanelLeft = 74, kPanelRight = 22, kPanelTop = 108, kPanelBottom = 62;

/// Where a panel's values are on the page.
struct PanelFrame {
  double left;
  int first_x, last_x;
  PlotAxis axis;

  double x(double value) const {
    return left + kPanelWidth * (value - first_x + 0.5) / (last_x - first_x + 1);
  }
  double y(double value) const { return kPanelTop + kPanelHeight * (1 - axis.share(value)); }
  double bottom() const { return kPanelTop + kPanelHeight; }
};

PanelFrame frame_of(const PlotPanel& panel, double left) {
  std::vector<double> means, reach;
  int first = 0, last = 0;
  for (const PlotSeries& series : panel.series) {
    for (const PlotPoint& point : series.points) {
      first = means.empty() ? point.x : std::min(first, point.x);
      last = means.empty() ? point.x : std::max(last, point.x);
      means.push_back(point.mean);
      reach.push_back(point.mean + point.deviation);
    }
  }
  return {left, first, last, PlotAxis(means, reach)};
}

std::string draw_axes(const PlotPanel& panel, const PanelFrame& frame, const std::string& x_label) {
  const double right = frame.left + kPanelWidth, middle = frame.left + kPanelWidth / 2;
  std::string svg = svg_text(middle, kPanelTop - 16, "panel", panel.title);
  for (const double tick : frame.axis.ticks()) {
    svg += svg_line(frame.left, frame.y(tick), right, frame.y(tick), "class=\"grid\"");
    svg += svg_text(frame.left - 8, frame.y(tick) + 4, "tick-y", fmt::format("{:.10g}", tick));
  }
  for (int x = frame.first_x; x <= frame.last_x; ++x) {
    svg += svg_line(frame.x(x), frame.bottom(), frame.x(x), frame.bottom() + 5, "class=\"axis\"");
    svg += svg_text(frame.x(x), frame.bottom() + 20, "tick-x", std::to_string(x));
  }
  svg += svg_line(frame.left, kPanelTop, frame.left, frame.bottom(), "class=\"axis\"");
  svg += svg_line(frame.left, frame.bottom(), right, frame.bottom(), "class=\"axis\"");
  svg += svg_text(middle, frame.bottom() + 44, "label", x_label);
  return svg + fmt::format(
                   "<text class=\"label\" transform=\"translate({:.1f} {:.1f}) "
                   "rotate(-90)\">{}</text>\n",
                   frame.left - 54, kPanelTop + kPanelHeight / 2, xml_escaped(panel.unit));
}

/// A bar that leaves the axis below points there with a short arrow.
std::string draw_bar(const PlotPoint& point, double x, const PanelFrame& frame, const char* color) {
  const std::string look = fmt::format("stroke=\"{}\" stroke-width=\"1.4\"", color);
  const double low = point.mean - point.deviation, middle = frame.y(point.mean);
  const double top = frame.y(point.mean + point.deviation);
  std::string svg = svg_line(x, top, x, middle, look) + svg_line(x - 4, top, x + 4, top, look);
  if (low >= frame.axis.low()) {
    const double bottom = frame.y(low);
    return svg + svg_line(x, middle, x, bottom, look) +
           svg_line(x - 4, bottom, x + 4, bottom, look);
  }
  const double tip = std::min(middle + 22, frame.bottom());
  return svg + svg_line(x, middle, x, tip, look) + svg_line(x - 3.5, tip - 6, x, tip, look) +
         svg_line(x + 3.5, tip - 6, x, tip, look);
}

/// Series stand a little beside each other, so that no bar hides another one.
std::string draw_series(const PlotPanel& panel, std::size_t index, const PanelFrame& frame) {
  const PlotStyle style = plot_style(index);
  const double step = std::min(0.2, 0.6 / double(panel.series.size()));
  const double beside = step * (double(index) - 0.5 * double(panel.series.size() - 1));
  std::string bars, marks, way;
  for (const PlotPoint& point : panel.series[index].points) {
    const double x = frame.x(point.x + beside), y = frame.y(point.mean);
    if (point.deviation > 0) bars += draw_bar(point, x, frame, style.color);
    marks += plot_mark(index, x, y);
    way += fmt::format("{}{:.1f} {:.1f}", way.empty() ? "M" : "L", x, y);
  }
  if (way.empty()) return "";
  return fmt::format(
             "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.8\" "
             "stroke-dasharray=\"{}\"/>\n",
             way, style.color, style.dashes) +
         bars + marks;
}

std::string draw_legend(const std::vector<PlotSeries>& series, double x) {
  std::string svg;
  for (std::size_t i = 0; i < series.size(); ++i) {
    const PlotStyle style = plot_style(i);
    svg += svg_line(x, 62, x + 40, 62,
                    fmt::format("stroke=\"{}\" stroke-width=\"1.8\" stroke-dasharray=\"{}\"",
                                style.color, style.dashes));
    svg += plot_mark(i, x + 20, 62) + svg_text(x + 48, 66, "legend", series[i].name);
    x += 76 + 7.5 * double(series[i].name.size());
  }
  return svg;
}

}  // namespace

std::string error_plot_svg(const std::string& title, const std::string& x_label,
                           const std::vector<PlotPanel>& panels) {
  const double pitch = kPanelLeft + kPanelWidth + kPanelRight;
  const double width = pitch * double(std::max<std::size_t>(panels.size(), 1));
  const double height = kPanelTop + kPanelHeight + kPanelBottom + 20;
  std::string svg = svg_text(kPanelLeft - 54, 32, "title", title);
  if (!panels.empty()) svg += draw_legend(panels.front().series, kPanelLeft - 54);
  bool logarithmic = false;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const PanelFrame frame = frame_of(panels[i], double(i) * pitch + kPanelLeft);
    logarithmic = logarithmic || frame.axis.logarithmic();
    svg += draw_axes(panels[i], frame, x_label);
    for (std::size_t s = 0; s < panels[i].series.size(); ++s)
      svg += draw_series(panels[i], s, frame);
  }
  svg += svg_text(kPanelLeft - 54, height - 12, "note",
                  std::string("Means; bars: one sample standard deviation each way") +
                      (logarithmic ? "; an arrow where it extends below the scale" : ""));
  return svg_page(width, height, svg);
}

}  // namespace vantage
