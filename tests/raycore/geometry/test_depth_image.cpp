#include "vantage/raycore/depth_image.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <memory>

#include "support/expect_error.hpp"
#include "support/non_finite.hpp"

using namespace vantage;
using namespace vantage::test;

TEST_CASE("a new depth image is unknown everywhere") {
  const DepthImage depth(3, 2);
  CHECK((depth.width() == 3 && depth.height() == 2 && depth.metres().size() == 6));
  for (const float metres : depth.metres()) CHECK(std::isnan(metres));
}

TEST_CASE("zero, infinity and NaN are unknown, row by row") {
  DepthImage depth(3, 2, {0.5f, 0, -0.f, DepthImage::kUnknown, kInfinity, 2});
  CHECK(depth.at(0, 0) == 0.5f);
  CHECK(depth.at(2, 1) == 2);
  for (const auto& [u, v] : {std::pair{1, 0}, {2, 0}, {0, 1}, {1, 1}}) {
    CHECK(std::isnan(depth.at(u, v)));
  }
  depth.set(1, 1, 0.75f);
  CHECK(depth.at(1, 1) == 0.75f);
  CHECK(depth.metres()[4] == 0.75f);
}

TEST_CASE("raw counts times the scale are millimetres") {
  RawDepthImage counts(2, 2);
  counts.samples = {0, 1, 1000, 65534};
  const DepthImage depth = DepthImage::from_counts(counts, 0.1);
  CHECK(std::isnan(depth.at(0, 0)));
  CHECK(depth.at(1, 0) == doctest::Approx(1e-4));
  CHECK(depth.at(0, 1) == doctest::Approx(0.1));
  CHECK(depth.at(1, 1) == doctest::Approx(6.5534));
  counts.samples[3] = 65535;  // saturated
  CHECK(std::isnan(DepthImage::from_counts(counts, 0.1).at(1, 1)));
}

TEST_CASE("a scale so large or small that depths overflow or vanish leaves them unknown") {
  RawDepthImage counts(1, 1);
  counts.samples = {60000};
  for (const double scale_mm : {1e60, 1e-60}) {
    CHECK(std::isnan(DepthImage::from_counts(counts, scale_mm).at(0, 0)));
  }
}

TEST_CASE("invalid depth images are refused") {
  expect_bad_input("depth", "0×4", [] { DepthImage(0, 4); });
  expect_bad_input("depth", "4×-1", [] { DepthImage(4, -1); });
  expect_bad_input("a.png", "3 depths for 2×2", [] { DepthImage(2, 2, {1, 2, 3}, "a.png"); });
  expect_bad_input("a.png", "pixel (1, 1) has the depth -0.25", [] {
    DepthImage(2, 2, {1, 2, 3, -0.25f}, "a.png");
  });
  expect_bad_input("depth", "-inf", [] { DepthImage(1, 1, {-kInfinity}); });
  const RawDepthImage counts(2, 2, 1);
  for (const double scale : {0.0, -1.0, HUGE_VAL, std::nan("")}) {
    expect_bad_input("b.png", "depth scale",
                     [&] { DepthImage::from_counts(counts, scale, "b.png"); });
  }
  expect_bad_input("b.png", "0×0", [] { DepthImage::from_counts(RawDepthImage(), 1, "b.png"); });
  RawDepthImage torn(2, 2, 1);
  torn.samples.resize(9);
  expect_bad_input("b.png", "9 depths for 2×2", [&] { DepthImage::from_counts(torn, 1, "b.png"); });
}

TEST_CASE("a depth image must have its camera's size") {
  const PinholeCamera camera({4, 3, 10, 10, 2, 1}, Pose());
  const auto fits = std::make_shared<DepthImage>(4, 3);
  CHECK(PosedDepth(camera, fits).depth == fits);
  expect_bad_input("frame 1", "3×4",
                   [&] { PosedDepth(camera, std::make_shared<DepthImage>(3, 4), "frame 1"); });
  expect_bad_input("frame 1", "4×3",
                   [&] { PosedDepth(camera, std::make_shared<DepthImage>(3, 4), "frame 1"); });
  expect_bad_input("frame 2", "no depth image", [&] { PosedDepth(camera, nullptr, "frame 2"); });
}
