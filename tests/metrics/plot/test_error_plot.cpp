#include "metrics/plot/error_plot.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "metrics/count_parts.hpp"
#include "metrics/plot/plot_axis.hpp"

namespace vantage {
namespace {

using test::count;

std::vector<PlotPanel> one_panel(const std::vector<PlotPoint>& points) {
  return {{"Error", "mm", {{"first", points}, {"second", points}}}};
}

}  // namespace

TEST_CASE("an axis is linear from zero while values are alike") {
  const PlotAxis axis({1, 2, 4}, {5.5});
  CHECK_FALSE(axis.logarithmic());
  CHECK(axis.share(0) == 0);
  CHECK(axis.ticks().front() == 0);
  CHECK(axis.ticks().back() >= 5.5);
  CHECK(axis.share(axis.ticks().back()) == doctest::Approx(1));
  CHECK(axis.ticks().size() <= 8);
}

TEST_CASE("an axis is logarithmic where values differ much, and its ticks are round") {
  const PlotAxis axis({0.03, 0.4, 7}, {9});
  CHECK(axis.logarithmic());
  CHECK(axis.share(0.3) - axis.share(0.03) == doctest::Approx(axis.share(3) - axis.share(0.3)));
  const std::vector<double> expected{0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10};
  const auto ticks = axis.ticks();
  REQUIRE(ticks.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(std::abs(ticks[i] / expected[i] - 1) < 1e-9);
  }
  CHECK(axis.share(0) == 0);  // below the axis
  CHECK(axis.share(10) == doctest::Approx(1));
}

TEST_CASE("a long logarithmic axis has powers of ten alone") {
  const PlotAxis axis({1e-3, 1e3}, {});
  for (const double tick : axis.ticks()) {
    CHECK(std::abs(std::log10(tick) - std::round(std::log10(tick))) < 1e-9);
  }
  CHECK(axis.ticks().size() == 7);  // from 0.0005 up
}

TEST_CASE("zeros and nothing at all have an axis, too") {
  CHECK_FALSE(PlotAxis({0, 5}, {}).logarithmic());
  CHECK(PlotAxis({}, {}).ticks().size() > 1);
  CHECK(PlotAxis({0, 0}, {0}).share(0) == 0);
}

TEST_CASE("a plot has a mark for each value, bars, a legend, and no NaN") {
  const std::string svg =
      error_plot_svg("Title", "cameras", one_panel({{2, 1, 0.5}, {3, 0.5, 0.1}, {4, 0.2, 0}}));
  CHECK(svg.starts_with("<svg xmlns="));
  CHECK(svg.ends_with("</svg>\n"));
  CHECK(count(svg, "class=\"mark\"") == 2 * (3 + 1));  // and the legend's
  CHECK(count(svg, ">first</text>") == 1);
  CHECK(count(svg, ">second</text>") == 1);
  CHECK(count(svg, ">mm</text>") == 1);
  CHECK(count(svg, ">cameras</text>") == 1);
  for (const char* never : {"nan", "inf", "href", "<script"}) CHECK(count(svg, never) == 0);
}

TEST_CASE("everything stays on the page") {
  const std::string svg =
      error_plot_svg("T", "x", one_panel({{2, 0.01, 5}, {3, 100, 900}, {9, 3, 3}}));
  for (const char* name : {" y1=\"", " y2=\"", " cy=\"", " x1=\"", " x2=\""}) {
    for (auto at = svg.find(name); at != std::string::npos; at = svg.find(name, at + 1)) {
      const double value = std::stod(svg.substr(at + std::string(name).size()));
      CHECK(value >= 0);
      CHECK(value <= 490);
    }
  }
}

TEST_CASE("texts may have any characters") {
  const std::string svg = error_plot_svg("a < b & \"c\"", "x", {});
  CHECK(svg.find("a &lt; b &amp; &quot;c&quot;") != std::string::npos);
}

}  // namespace vantage
