#include "reconstruct/depth_lens.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "vantage/reconstruction/calibration.hpp"

namespace vantage::test {
namespace {

constexpr Intrinsics kDataset{160, 120, 131, 131, 80, 60}, kCalibrated{160, 120, 130, 130, 79, 59};

/// One image with depth: 1 m, and 2 m at the corner (0, 0).
BopScene scene_with_corner() {
  DepthImage depth(160, 120, std::vector<float>(160 * 120, 1.f));
  depth.set(0, 0, 2.f);
  BopScene scene;
  scene.images.push_back(
      {0, "image", kDataset, {}, {}, std::make_shared<const DepthImage>(depth), {}});
  return scene;
}

/// The scene after `apply_depth_lens` with a lens of this k1.
BopScene applied(DepthLens kind, double k1, bool with_calibration = true) {
  const TemporaryFolder folder;
  const auto file = folder.write("camera.yml", calibration_yaml(Lens(kCalibrated, {k1})));
  BopScene scene = scene_with_corner();
  std::vector<std::filesystem::path> calibrations;
  if (with_calibration) calibrations.push_back(file);
  apply_depth_lens(kind, calibrations, scene);
  return scene;
}

}  // namespace

TEST_CASE("depth of a lens that distorts: rectified where it is asked for, and else said") {
  const BopScene said = applied(DepthLens::calibrated, -0.15);
  CHECK(said.warnings.empty());
  CHECK(said.images[0].intrinsics == kCalibrated);
  CHECK(said.images[0].depth->at(0, 0) == 1.f);  // that corner shows what is farther in now
  CHECK(said.images[0].depth->at(79, 59) == 1.f);

  const BopScene unsaid = applied(DepthLens::unsaid, -0.15);
  REQUIRE(unsaid.warnings.size() == 1);
  CHECK(unsaid.warnings[0].find("--depth-lens calibrated") != std::string::npos);
  CHECK(unsaid.images[0].intrinsics == kDataset);
  CHECK(unsaid.images[0].depth->at(0, 0) == 2.f);

  CHECK(applied(DepthLens::pinhole, -0.15).warnings.empty());
  CHECK(applied(DepthLens::unsaid, -0.001).warnings.empty());  // a tenth of a pixel
  CHECK(applied(DepthLens::unsaid, -0.15, false).warnings.empty());
  CHECK(applied(DepthLens::calibrated, -0.15, false).images[0].intrinsics == kDataset);
  expect_bad_input("--depth-lens", "found raw", [] { depth_lens_of("raw", "--depth-lens"); });
}

}  // namespace vantage::test
