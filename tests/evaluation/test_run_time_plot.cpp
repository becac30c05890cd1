#include "evaluation/run_time_plot.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "evaluation/label_places.hpp"
#include "evaluation/plot_axis.hpp"

namespace vantage {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

PlotBox around(double x, double y, double width, double height) {
  return {x - width / 2, y - height / 2, x + width / 2, y + height / 2};
}

}  // namespace

TEST_CASE("labels hide neither marks nor each other, and stay on the page") {
  const PlotBox page{0, 0, 400, 300};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> x(10, 390), y(10, 290);
  std::vector<LabelledPoint> points;
  for (int i = 0; i < 40; ++i) points.push_back({x(random), y(random)});
  for (int i = 0; i < 6; ++i) points.push_back({200.0 + 3 * i, 8});  // a crowd at the border
  const auto places = label_places(points, 9, 12, 5, page);
  REQUIRE(places.size() == points.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    CAPTURE(i);
    const PlotBox label = around(places[i].x, places[i].y, 9, 12);
    CHECK(label.within(page));
    for (const LabelledPoint& p : points) CHECK_FALSE(label.meets(around(p.x, p.y, 10, 10)));
    for (std::size_t j = 0; j < i; ++j) {
      CHECK_FALSE(label.meets(around(places[j].x, places[j].y, 9, 12)));
    }
    const double distance = std::hypot(places[i].x - points[i].x, places[i].y - points[i].y);
    CHECK(places[i].away == (distance > 14));
  }
}

TEST_CASE("a lonely label stands right beside its mark") {
  const auto places = label_places({{50, 50}}, 9, 12, 5, {0, 0, 100, 100});
  CHECK(places[0].x == 62);
  CHECK(places[0].y == 50);
  CHECK_FALSE(places[0].away);
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
