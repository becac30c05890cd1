#include "metrics/plot/run_time_plot.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "metrics/count_parts.hpp"
#include "metrics/plot/label_layout.hpp"
#include "metrics/plot/plot_axis.hpp"

namespace vantage {
namespace {

using test::count;

}  // namespace

TEST_CASE("stacked marks cover none, and rise only where others are in the way") {
  const MarkCell cell{7, 18, 15};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(0, 400), y(100, 300);
  std::vector<PagePoint> points;
  for (int i = 0; i < 40; ++i) points.push_back({x(random), y(random)});
  for (int i = 0; i < 12; ++i) points.push_back({200.0 + 3 * i, 50});  // a crowd
  const std::vector<double> stacks = stacked(points, cell);
  REQUIRE(stacks.size() == points.size());
  std::size_t risen = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    CAPTURE(i);
    CHECK(stacks[i] <= points[i].y);
    bool rests = stacks[i] == points[i].y;
    risen += !rests;
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (j == i || std::abs(points[i].x - points[j].x) >= 25) continue;
      CHECK(std::abs(stacks[i] - stacks[j]) > 15 - 1e-9);
      rests |= std::abs(stacks[j] - stacks[i] - 15) < 1e-9;
    }
    CHECK(rests);
  }
  CHECK(risen > 8);
  CHECK(risen < 30);
}

TEST_CASE("an axis is logarithmic where that is asked for, however alike values are") {
  const PlotAxis axis({2, 3}, {}, PlotScale::logarithmic);
  CHECK(axis.logarithmic());
  CHECK(axis.share(2) > 0);
  CHECK(axis.share(3) <= 1);
  CHECK_FALSE(PlotAxis({0, 3}, {}, PlotScale::logarithmic).logarithmic());
}

TEST_CASE("a chart has a mark and a number for every pick, and hollow ones for the thesis'") {
  const std::string svg = run_time_plot_svg(
      "Title", {"wall:front", "a & b"},
      {{"voxel", {{0, 0.5, 1}, {1, 0.6, 1}}, {{0, 234.8, 1}}}, {"shadowD6", {{0, 2, 0.9}}, {}}});
  CHECK(svg.starts_with("<svg xmlns="));
  CHECK(svg.ends_with("</svg>\n"));
  CHECK(count(svg, "class=\"mark\"") == 4 + 2);  // and the legend's
  CHECK(count(svg, "fill=\"#fff\" stroke=") == 1);
  CHECK(count(svg, ">1</text>") == 3 + 1);  // and the axis'
  CHECK(count(svg, ">2</text>") == 1);
  CHECK(count(svg, "1  wall:front</text>") == 1);
  CHECK(count(svg, "2  a &amp; b</text>") == 1);
  CHECK(count(svg, "Hollow: the thesis") == 1);
  for (const char* never : {"nan", "inf", "href", "<script"}) CHECK(count(svg, never) == 0);
}

TEST_CASE("a chart without picks is empty, but a chart") {
  const std::string svg = run_time_plot_svg("T", {}, {{"voxel", {}, {}}});
  CHECK(count(svg, "class=\"mark\"") == 1);  // the legend's
  CHECK(count(svg, "Hollow") == 0);
  for (const char* never : {"nan", "inf"}) CHECK(count(svg, never) == 0);
}

TEST_CASE("ratios above 1 are on the chart, too") {
  const std::string svg = run_time_plot_svg("T", {"s"}, {{"voxel", {{0, 1, 1.07}}, {}}});
  CHECK(count(svg, ">1.08</text>") == 1);
}

}  // namespace vantage
