// What is wrong with an observation, in words.

#include <doctest/doctest.h>

#include "support/non_finite.hpp"
#include "vantage/reconstruction/observation.hpp"

using namespace vantage;

namespace {

Observation marker(std::vector<Eigen::Vector2d> corners, double sigma_px = 0.1) {
  return {{"aruco", "4X4/1"}, SeenPoints{std::move(corners), sigma_px}};
}

}  // namespace

TEST_CASE("a good observation has no fault") {
  CHECK(fault_of(marker({{0, 0}, {9, 1}, {8, 9}, {-1, 8}})).empty());
  CHECK(fault_of({{"keypoint", "spout"}, SeenPoints{{{3, 4}}, 1}}).empty());
  CHECK(fault_of({{"keypoint", "line"}, SeenPoints{{{3, 4}, {5, 6}, {7, 8}}, 1}}).empty());
  CHECK(fault_of({{"pose", "mug"}, SeenPose{}}).empty());
  CHECK(fault_of({{"color", "red"}, SeenLabel{{0, 0, 1}}}).empty());
}

TEST_CASE("faults of points are named") {
  CHECK(fault_of({{"keypoint", "spout"}, SeenPoints{}}) == "there are no points");
  CHECK(fault_of({{"keypoint", "x"}, SeenPoints{{{3, 4}, {test::kNaN, 1}}, 1}}) ==
        "point 1 is not finite");
  CHECK(fault_of(marker({{0, 0}, {9, 1}, {8, HUGE_VAL}, {-1, 8}})) == "corner 2 is not finite");
  CHECK(fault_of(marker({{0, 0}, {9, 1}, {9, 1}, {-1, 8}})) == "corner 2 is the same as corner 1");
  CHECK(fault_of(marker({{0, 0}, {9, 1}, {8, 9}})) == "a marker with 3 corners");
  CHECK(fault_of(marker({{0, 0}, {9, 1}, {-1, 8}, {8, 9}})) ==
        "the corners do not form a convex quadrilateral");
  CHECK(fault_of(marker({{0, 0}, {9, 0}, {4, 2}, {0, 9}})) ==
        "the corners do not form a convex quadrilateral");
  CHECK(fault_of(marker({{-1, 8}, {8, 9}, {9, 1}, {0, 0}})) ==
        "the corners are in the wrong order, as if seen from behind");
  CHECK(fault_of(marker({{0, 0}, {.5, 0}, {.5, .5}, {0, .5}})) ==
        "the marker covers only 0.25 px²");
}

TEST_CASE("a standard deviation is a positive number") {
  for (const double sigma : {0.0, -1.0, double(test::kNaN), HUGE_VAL}) {
    CAPTURE(sigma);
    CHECK(fault_of(marker({{0, 0}, {9, 1}, {8, 9}, {-1, 8}}, sigma)).find("sigma_px") == 0);
    CHECK(fault_of({{"pose", "mug"}, SeenPose{{}, sigma, 1}}).find("sigma_m") == 0);
    CHECK(fault_of({{"pose", "mug"}, SeenPose{{}, 1, sigma}}).find("sigma_rad") == 0);
    CHECK(fault_of({{"color", "red"}, SeenLabel{{0, 0, 1}, sigma}}).find("sigma_m") == 0);
  }
  CHECK(fault_of({{"color", "red"}, SeenLabel{{0, test::kNaN, 1}}}) == "the point is not finite");
}
