#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>

#include "support/detect_markers.hpp"
#include "support/expect_error.hpp"
#include "vantage/reconstruction/marker.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

std::string picture(const MarkerCells& cells) {
  std::string text;
  for (std::size_t i = 0; i < cells.white.size(); ++i) {
    text += cells.white[i] ? '#' : '.';
    if ((i + 1) % std::size_t(cells.side) == 0) text += '\n';
  }
  return text;
}

/// The marker on white, `cell_px` pixels for each cell.
ColorImage draw(const MarkerCells& cells, int cell_px) {
  const int side = (cells.side + 4) * cell_px;
  ColorImage image(side, side, 255);
  for (int v = 0; v < cells.side * cell_px; ++v) {
    for (int u = 0; u < cells.side * cell_px; ++u) {
      if (cells.white[std::size_t(v / cell_px * cells.side + u / cell_px)]) continue;
      std::fill_n(image.pixel(u + 2 * cell_px, v + 2 * cell_px), 3, std::uint8_t(0));
    }
  }
  return image;
}

}  // namespace

TEST_CASE("the first marker of 4X4_50 is the one that everybody prints") {
  const MarkerCells cells = marker_cells("4X4_50", 0, "test");
  CHECK(cells.side == 6);
  CHECK(picture(cells) ==
        "......\n"
        ".#.##.\n"
        "..#.#.\n"
        "...##.\n"
        "...#..\n"
        "......\n");
}

TEST_CASE("OpenCV finds the markers of every dictionary by their cells") {
  CHECK(marker_dictionaries().size() == 21);
  for (const std::string& dictionary : marker_dictionaries()) {
    CAPTURE(dictionary);
    for (const int id : {3, 29}) {
      const MarkerCells cells = marker_cells(dictionary, id, "test");
      const auto found = detect_markers(draw(cells, 8), dictionary);
      REQUIRE(found.size() == 1);
      CHECK(found[0].id == id);
      // Pixel centres are at integers: the first black pixel's edge is half a pixel before it.
      const double low = 15.5, high = low + 8 * cells.side;
      const std::array<Eigen::Vector2d, 4> truth = {
          {{low, low}, {high, low}, {high, high}, {low, high}}};
      for (std::size_t i = 0; i < 4; ++i) CHECK((found[0].corners[i] - truth[i]).norm() < 0.02);
    }
  }
}

TEST_CASE("dictionaries have as many markers as their names say") {
  CHECK(marker_count("4X4_50", "test") == 50);
  CHECK(marker_count("7X7_1000", "test") == 1000);
  CHECK(marker_count("ARUCO_ORIGINAL", "test") == 1024);
  CHECK_NOTHROW(marker_cells("APRILTAG_36h11", marker_count("APRILTAG_36h11", "test") - 1, "test"));
}

TEST_CASE("unknown dictionaries and ids are refused with those that there are") {
  expect_refused([] { marker_cells("4X4_51", 0, "cell.yaml:7: dictionary"); },
                 "cell.yaml:7: dictionary", {"'4X4_51'", "4X4_50, 4X4_100", "APRILTAG_36h11"});
  expect_refused([] { marker_cells("6X6_250", 250, "cell.yaml:8: id"); }, "cell.yaml:8: id",
                 {"6X6_250 has no id 250", "0 to 249"});
  expect_refused([] { marker_cells("6X6_250", -1, "id"); }, "id", {"-1", "0 to 249"});
  expect_refused([] { marker_count("6X6", "here"); }, "here", {"'6X6'", "6X6_250"});
}

TEST_CASE("a marker's corners go around as OpenCV's do") {
  // Seen by someone who looks along -z, the marker is turned to the left by a quarter.
  Eigen::Matrix3d quarter;
  quarter << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const Marker marker{"4X4_50", 1, 0.2, Pose::from_rotation(quarter, {1, 2, 3})};
  const auto corners = marker.corners();
  CHECK(corners[0].isApprox(Eigen::Vector3d(0.9, 1.9, 3)));  // upper left has come to lower left
  CHECK(corners[1].isApprox(Eigen::Vector3d(0.9, 2.1, 3)));
  CHECK(corners[2].isApprox(Eigen::Vector3d(1.1, 2.1, 3)));
  CHECK(corners[3].isApprox(Eigen::Vector3d(1.1, 1.9, 3)));
}
