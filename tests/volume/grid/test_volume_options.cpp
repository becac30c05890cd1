#include <doctest/doctest.h>

#include <limits>

#include "support/expect_error.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {
namespace {

void expect_refused(const char* key, const VolumeOptions& options) {
  test::expect_bad_input(key, "expected a finite number", [&] { options.check(); });
}

}  // namespace

TEST_CASE("volume options: the defaults are valid, and so are a sensor and a band without noise") {
  CHECK_NOTHROW(VolumeOptions{}.check());
  VolumeOptions exact;
  exact.band_sigmas = 0;
  exact.noise.subpixel_px = 0;
  CHECK_NOTHROW(exact.check());
}

TEST_CASE("volume options: values that are not finite or out of range are refused, by their key") {
  for (const double bad :
       {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    VolumeOptions options;
    options.band_sigmas = bad;
    expect_refused("band_sigmas", options);
    options = {};
    options.noise.focal_px = bad;
    expect_refused("noise.focal_px", options);
    options = {};
    options.noise.baseline_m = bad;
    expect_refused("noise.baseline_m", options);
    options = {};
    options.noise.subpixel_px = bad;
    expect_refused("noise.subpixel_px", options);
  }
  VolumeOptions options;
  options.noise.baseline_m = 0;
  test::expect_bad_input("noise.baseline_m", "is 0; expected a finite number, above 0",
                         [&] { options.check(); });
}

TEST_CASE(
    "stereo noise grows with the square of the distance, and anti-aliasing follows the mode") {
  const StereoNoise d435;
  CHECK(d435.sigma_m(0.5) == doctest::Approx(0.00094).epsilon(0.01));
  CHECK(d435.sigma_m(2) == doctest::Approx(16 * d435.sigma_m(0.5)));
  VolumeOptions options;
  CHECK_FALSE(options.anti_aliased());
  options.occluders = OccluderMode::voxels;
  CHECK(options.anti_aliased());
  options.anti_alias = false;
  CHECK_FALSE(options.anti_aliased());
}

}  // namespace vantage
