#include <doctest/doctest.h>

#include <limits>
#include <vantage/raycore/box.hpp>

#include "support/expect_error.hpp"

using namespace vantage;
using Eigen::Vector3d;

TEST_CASE("a box knows its measures") {
  const Box box({1, 2, 3}, {2, 4, 7});
  CHECK(box.size() == Vector3d(1, 2, 4));
  CHECK(box.centre() == Vector3d(1.5, 3, 5));
  CHECK(box.volume_m3() == doctest::Approx(8));
}

TEST_CASE("a box contains its boundary and nothing beyond it") {
  const Box box({0, 0, 0}, {1, 1, 1});
  CHECK(box.contains({0, 0.5, 1}));
  CHECK_FALSE(box.contains({0.5, 0.5, 1.0000001}));
  CHECK_FALSE(box.contains({-1e-9, 0.5, 0.5}));
  CHECK_FALSE(box.contains({std::numeric_limits<double>::quiet_NaN(), 0.5, 0.5}));
}

TEST_CASE("a box without a volume is refused with its corners and size") {
  test::expect_bad_input("work area", "min (0, 0, 0) and max (1, 0, 1) give the size (1, 0, 1)",
                         [] {
                           Box({0, 0, 0}, {1, 0, 1}, "work area");
                         });
  test::expect_bad_input("box", "(-1, 1, 1)", [] { Box({1, 0, 0}, {0, 1, 1}); });
}

TEST_CASE("a box with a corner that is not finite is refused") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  test::expect_bad_input("box", "nan", [=] { Box({nan, 0, 0}, {1, 1, 1}); });
  test::expect_bad_input("box", "inf", [=] { Box({0, 0, 0}, {1, 1, infinity}); });
}
