#include "metrics/plot/run_time_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "metrics/plot/label_layout.hpp"
#include "metrics/plot/plot_axis.hpp"
#include "metrics/plot/plot_marks.hpp"
#include "metrics/plot/svg.hpp"

namespace vantage {
namespace {

constexpr double kWidth = 900, kLeft = 80, kRight = 30, kTop = 118;
constexpr double kFrameWidth = kWidth - kLeft - kRight, kRatiosHeight = 306;
constexpr double kMinHead = 34;  // room above the highest ratio
constexpr double kLabel = 12;    // from a mark's middle to its number's
constexpr MarkCell kCell{.left = 6, .right = 17, .height = 12.5};
constexpr double kKeyTop = 66, kKeyLine = 20, kKeyColumns = 3;

/// A mark of the plot.
struct Mark {
  std::size_t series = 0;
  TimePlotPoint point;
  bool thesis = false;
};

std::vector<Mark> marks_of(const std::vector<TimePlotSeries>& series) {
  std::vector<Mark> marks;
  for (std::size_t s = 0; s < series.size(); ++s) {
    for (const TimePlotPoint& point : series[s].points) marks.push_back({s, point, false});
    for (const TimePlotPoint& point : series[s].thesis) marks.push_back({s, point, true});
  }
  return marks;
}

std::vector<double> times_of(const std::vector<Mark>& marks) {
  std::vector<double> times;
  for (const Mark& mark : marks) times.push_back(mark.point.run_time_s);
  return times;
}

/// Vox ratios from a round one below the least to a round one that is not below 1.
struct RatioAxis {
  double low = 0.9, high = 1, step = 0.02;

  explicit RatioAxis(const std::vector<Mark>& marks) {
    double least = 0.99, most = 1;
    for (const Mark& mark : marks) {
      least = std::min(least, mark.point.vox_ratio);
      most = std::max(most, mark.point.vox_ratio);
    }
    const double range = most - least;
    for (const double round : {0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002}) {
      if (range / round <= 6) step = round;
    }
    low = step * std::floor(least / step);
    high = step * std::ceil(most / step - 1e-9);
  }
};

struct Frame {
  PlotAxis times;
  RatioAxis ratios;
  double head = kMinHead;

  double x(double seconds) const { return kLeft + kFrameWidth * times.share(seconds); }
  double y(double ratio) const {
    const double share = (ratio - ratios.low) / (ratios.high - ratios.low);
    return kTop + head + kRatiosHeight * (1 - share);
  }
  double bottom() const { return kTop + head + kRatiosHeight; }
  static constexpr double kEnd = kLeft + kFrameWidth;
};

std::string seconds_text(double seconds) {
  return seconds < 1 ? fmt::format("{:.3g} ms", 1000 * seconds) : fmt::format("{:.3g} s", seconds);
}

/// Where on the page the marks belong, and where they stand.
struct MarkPlaces {
  std::vector<PagePoint> points;
  std::vector<double> y;

  MarkPlaces(const std::vector<Mark>& marks, const Frame& frame) {
    for (const Mark& mark : marks) {
      points.push_back({frame.x(mark.point.run_time_s), frame.y(mark.point.vox_ratio)});
    }
    y = stacked(points, kCell);
  }

  double top() const {
    return y.empty() ? kTop : *std::ranges::min_element(y) - 0.5 * kCell.height;
  }
};

/// With room for all stacks.
Frame frame_of(const std::vector<Mark>& marks) {
  Frame frame{PlotAxis(times_of(marks), {}, PlotScale::logarithmic), RatioAxis(marks)};
  frame.head += std::max(0.0, kTop - MarkPlaces(marks, frame).top());
  return frame;
}

std::string draw_axes(const Frame& frame) {
  std::string svg;
  for (double tick = frame.ratios.low; tick < frame.ratios.high + 0.5 * frame.ratios.step;
       tick += frame.ratios.step) {
    svg += svg_line(kLeft, frame.y(tick), Frame::kEnd, frame.y(tick), "class=\"grid\"");
    svg += svg_text(kLeft - 8, frame.y(tick) + 4, "tick-y", fmt::format("{:.4g}", tick));
  }
  for (const double tick : frame.times.ticks()) {
    svg += svg_line(frame.x(tick), kTop, frame.x(tick), frame.bottom(), "class=\"grid\"");
    svg += svg_text(frame.x(tick), frame.bottom() + 18, "tick-x", seconds_text(tick));
  }
  svg += svg_line(kLeft, kTop, kLeft, frame.bottom(), "class=\"axis\"");
  svg += svg_line(kLeft, frame.bottom(), Frame::kEnd, frame.bottom(), "class=\"axis\"");
  svg += svg_text(kLeft + kFrameWidth / 2, frame.bottom() + 40, "label",
                  "run time, from a classified grid to the answer");
  return svg + fmt::format(
                   "<text class=\"label\" transform=\"translate({:.1f} {:.1f}) "
                   "rotate(-90)\">vox ratio</text>\n",
                   kLeft - 56, kTop + frame.head + kRatiosHeight / 2);
}

std::string draw_legend(const std::vector<TimePlotSeries>& series) {
  std::string svg;
  double x = kLeft;
  bool thesis = false;
  for (std::size_t s = 0; s < series.size(); ++s) {
    svg += plot_mark(s, x, 62, MarkFill::full) + svg_text(x + 12, 66, "legend", series[s].name);
    x += 44 + 8 * double(series[s].name.size());
    thesis = thesis || !series[s].thesis.empty();
  }
  std::string note = "Leader lines end where a shifted mark belongs.";
  if (thesis) {
    note +=
        " Hollow: the thesis' figures, on its own scenes and machine (an i7-6700HQ with a GPU).";
  }
  return svg + svg_text(kLeft - 6, 92, "note", note);
}

std::string draw_marks(const std::vector<Mark>& marks, const Frame& frame) {
  const MarkPlaces places(marks, frame);
  std::string stems, svg;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const auto [x, y] = places.points[i];
    if (places.y[i] < y) {
      stems += svg_line(x, y, x, places.y[i], "stroke=\"#999\" stroke-width=\"0.8\"");
    }
    svg += plot_mark(marks[i].series, x, places.y[i],
                     marks[i].thesis ? MarkFill::hollow : MarkFill::full);
    svg +=
        svg_text(x + kLabel, places.y[i] + 4, "beside", std::to_string(marks[i].point.scene + 1));
  }
  return stems + svg;
}

std::string draw_key(const std::vector<std::string>& scenes, const Frame& frame) {
  std::string svg;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    const double column = std::fmod(double(i), kKeyColumns),
                 line = std::floor(double(i) / kKeyColumns);
    svg += svg_text(kLeft + column * kFrameWidth / kKeyColumns,
                    frame.bottom() + kKeyTop + kKeyLine * line, "legend",
                    fmt::format("{}  {}", i + 1, scenes[i]));
  }
  return svg;
}

}  // namespace

std::string run_time_plot_svg(const std::string& title, const std::vector<std::string>& scenes,
                              const std::vector<TimePlotSeries>& series) {
  const std::vector<Mark> marks = marks_of(series);
  const Frame frame = frame_of(marks);
  const double key_lines = std::ceil(double(scenes.size()) / kKeyColumns);
  return svg_page(kWidth, frame.bottom() + kKeyTop + kKeyLine * key_lines,
                  svg_text(kLeft - 56, 32, "title", title) + draw_legend(series) +
                      draw_axes(frame) + draw_marks(marks, frame) + draw_key(scenes, frame));
}

}  // namespace vantage
