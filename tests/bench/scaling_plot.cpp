#include "scaling_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "metrics/plot/plot_axis.hpp"
#include "metrics/plot/plot_marks.hpp"
#include "metrics/plot/svg.hpp"

namespace vantage::bench {
namespace {

constexpr double kPanel = 400, kFrameWidth = 310, kFrameHeight = 300;
constexpr double kLeft = 84, kTop = 90, kLegendTop = 70, kLegendLine = 22;
constexpr std::size_t kFittedPoints = 4;

struct Frame {
  double left;
  PlotAxis sizes, times;

  double x(double size) const { return left + kFrameWidth * sizes.share(size); }
  double y(double seconds) const { return kBottom - kFrameHeight * times.share(seconds); }
  static constexpr double kBottom = kTop + kFrameHeight;
};

std::string time_text(double seconds) {
  if (seconds < 0.9e-3) return fmt::format("{:.3g} µs", 1e6 * seconds);
  return seconds < 0.9 ? fmt::format("{:.3g} ms", 1e3 * seconds) : fmt::format("{:.3g} s", seconds);
}

std::string size_text(double size) {
  if (size < 999) return fmt::format("{:.0f}", size);
  return size < 0.9e6 ? fmt::format("{:.3g} k", 1e-3 * size) : fmt::format("{:.3g} M", 1e-6 * size);
}

Frame frame_of(const ScalingPanel& panel, double left) {
  std::vector<double> sizes, times;
  for (const ScalingSeries& series : panel.series) {
    sizes.insert(sizes.end(), series.size.begin(), series.size.end());
    times.insert(times.end(), series.seconds.begin(), series.seconds.end());
  }
  return {left, PlotAxis(sizes, {}, PlotScale::logarithmic),
          PlotAxis(times, {}, PlotScale::logarithmic)};
}

std::string draw_axes(const ScalingPanel& panel, const Frame& frame) {
  std::string svg;
  for (const double tick : frame.times.ticks()) {
    svg += svg_line(frame.left, frame.y(tick), frame.left + kFrameWidth, frame.y(tick),
                    "class=\"grid\"");
    svg += svg_text(frame.left - 8, frame.y(tick) + 4, "tick-y", time_text(tick));
  }
  for (const double tick : frame.sizes.ticks()) {
    svg += svg_line(frame.x(tick), kTop, frame.x(tick), Frame::kBottom, "class=\"grid\"");
    svg += svg_text(frame.x(tick), Frame::kBottom + 18, "tick-x", size_text(tick));
  }
  svg += svg_line(frame.left, kTop, frame.left, Frame::kBottom, "class=\"axis\"");
  svg += svg_line(frame.left, Frame::kBottom, frame.left + kFrameWidth, Frame::kBottom,
                  "class=\"axis\"");
  const double middle = frame.left + kFrameWidth / 2;
  svg += svg_text(middle, Frame::kBottom + 42, "label", panel.x_label);
  return svg + svg_text(middle, kTop - 16, "panel", panel.title);
}

std::string draw_series(const ScalingSeries& series, std::size_t index, const Frame& frame) {
  const PlotStyle style = plot_style(index);
  std::string points, marks;
  for (std::size_t i = 0; i < series.size.size(); ++i) {
    const double x = frame.x(series.size[i]), y = frame.y(series.seconds[i]);
    points += fmt::format("{:.1f},{:.1f} ", x, y);
    marks += plot_mark(index, x, y);
  }
  return fmt::format(
             "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" "
             "stroke-dasharray=\"{}\"/>\n",
             points, style.color, style.dashes) +
         marks;
}

std::string draw_legend(const ScalingSeries& series, std::size_t index, double left) {
  const double y = Frame::kBottom + kLegendTop + kLegendLine * double(index);
  return plot_mark(index, left + 8, y - 4) +
         svg_text(left + 22, y, "legend",
                  fmt::format("{}: ∝ n^{:.2f}", series.name, series.exponent()));
}

}  // namespace

double ScalingSeries::exponent() const {
  const std::size_t first = size.size() - std::min(size.size(), kFittedPoints);
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = first; i < size.size(); ++i) {
    const double x = std::log(size[i]), y = std::log(seconds[i]);
    n += 1, sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

std::string scaling_plot_svg(const std::string& title, const std::vector<ScalingPanel>& panels) {
  std::string svg = svg_text(24, 36, "title", title);
  std::size_t lines = 0;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    const Frame frame = frame_of(panels[p], kLeft + kPanel * double(p));
    svg += draw_axes(panels[p], frame);
    for (std::size_t s = 0; s < panels[p].series.size(); ++s) {
      svg += draw_series(panels[p].series[s], s, frame);
      svg += draw_legend(panels[p].series[s], s, frame.left);
    }
    lines = std::max(lines, panels[p].series.size());
  }
  return svg_page(kLeft + kPanel * double(panels.size()),
                  Frame::kBottom + kLegendTop + kLegendLine * double(lines), svg);
}

}  // namespace vantage::bench
