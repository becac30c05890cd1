#include "vantage/raycore/rectify_depth.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/expect_error.hpp"

namespace vantage::test {
namespace {

const Intrinsics kBentIntrinsics{160, 120, 130, 128, 80, 59};

/// Depth of the plane z = 1 + 0.3 x + 0.1 y, by the direction (x, y, 1).
float plane_depth(const Eigen::Vector2d& xy) {
  return float(1 / (1 - 0.3 * xy.x() - 0.1 * xy.y()));
}

/// What a camera behind the lens measures, by the lens' own inverse.
DepthImage seen_through(const Lens& lens) {
  const Intrinsics& k = lens.intrinsics();
  DepthImage depth(k.width, k.height);
  for (int v = 0; v < k.height; ++v) {
    for (int u = 0; u < k.width; ++u) {
      const Eigen::Vector2d guess((u - k.cx) / k.fx, (v - k.cy) / k.fy);
      depth.set(u, v, plane_depth(lens.sight(u, v, guess).xy));
    }
  }
  return depth;
}

}  // namespace

TEST_CASE("rectified depth is a pinhole's, whatever the lens") {
  for (const Distortion& distortion :
       {Distortion{-0.25, 0.08, 0.001, -0.002, 0}, Distortion::fisheye(0.05, -0.01, 0, 0)}) {
    const Lens lens(kBentIntrinsics, distortion);
    const DepthImage raw = seen_through(lens), rectified = rectify_depth(raw, lens);
    double worst = 0, worst_raw = 0;
    int known = 0;
    for (int v = 0; v < raw.height(); ++v) {
      for (int u = 0; u < raw.width(); ++u) {
        const Intrinsics& k = kBentIntrinsics;
        const float expected = plane_depth({(u - k.cx) / k.fx, (v - k.cy) / k.fy});
        worst_raw = std::max(worst_raw, double(std::abs(raw.at(u, v) - expected)));
        if (std::isnan(rectified.at(u, v))) continue;
        ++known;
        worst = std::max(worst, double(std::abs(rectified.at(u, v) - expected)));
      }
    }
    CHECK(worst < 0.006);  // what the plane changes by within half a pixel
    CHECK(worst_raw > 0.02);
    CHECK(known > raw.width() * raw.height() / 2);
  }
}

TEST_CASE("rectified depth: without distortion nothing changes, and sizes have to fit") {
  const Lens lens(kBentIntrinsics, {});
  DepthImage depth(160, 120);
  depth.set(0, 0, 1.5f);
  depth.set(159, 119, 2.5f);
  const DepthImage same = rectify_depth(depth, lens);
  CHECK(same.at(0, 0) == 1.5f);
  CHECK(same.at(159, 119) == 2.5f);
  CHECK(std::isnan(same.at(80, 60)));
  CHECK(max_displacement_px(lens) < 1e-9);
  expect_bad_input("here", "160×120", [&] { rectify_depth(DepthImage(80, 60), lens, "here"); });
}

TEST_CASE("the largest displacement is that of the farthest corner") {
  const Intrinsics k{160, 120, 130, 130, 79.5, 59.5};
  const double r2 = (79.5 * 79.5 + 59.5 * 59.5) / (130 * 130);
  const double expected_px = 0.1 * r2 * std::sqrt(r2) * 130;
  // With k1 < 0 the image shows more than the pinhole's: no corner is left out.
  CHECK(max_displacement_px(Lens(k, {-0.1})) == doctest::Approx(expected_px).epsilon(1e-6));
}

}  // namespace vantage::test
