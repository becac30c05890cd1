#include "reconstruct/calibration_list.hpp"

#include <doctest/doctest.h>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "vantage/reconstruction/calibration.hpp"

namespace vantage::test {
namespace {

const Intrinsics kListIntrinsics{640, 480, 600, 600, 320, 240};

BopScene scene_of_images(std::vector<int> ids) {
  BopScene scene;
  for (const int id : ids) {
    scene.images.push_back({id, "image", kListIntrinsics, {}, {}, nullptr, {}});
  }
  return scene;
}

/// Calibrations that differ in k1.
struct ListedFiles {
  TemporaryFolder folder;
  std::string a = write("a.yml", 0.1), b = write("b.yml", 0.2);

  std::string write(const char* name, double k1) {
    return folder.write(name, calibration_yaml(Lens(kListIntrinsics, {k1}))).string();
  }
};

}  // namespace

TEST_CASE("calibrations belong to images by their order or by their ids") {
  const ListedFiles files;
  const BopScene scene = scene_of_images({3, 7});
  const auto k1 = [&](const std::vector<std::filesystem::path>& given) {
    std::vector<double> all;
    for (const Lens& lens : lenses_of(scene, given)) all.push_back(lens.distortion().k1);
    return all;
  };
  CHECK(k1({}) == std::vector{0.0, 0.0});
  CHECK(k1({files.a}) == std::vector{0.1, 0.1});
  CHECK(k1({files.a, files.b}) == std::vector{0.1, 0.2});
  CHECK(k1({"7=" + files.a, "3=" + files.b}) == std::vector{0.2, 0.1});
  CHECK(calibration_files({"7=" + files.a, "3=" + files.b + "#cam0", files.a}) ==
        std::vector<std::filesystem::path>{files.a, files.b});
  const auto refused = [&](const std::vector<std::filesystem::path>& given,
                           std::string_view message) {
    expect_bad_input("calibration", message, [&] { lenses_of(scene, given); });
  };
  refused({files.a, files.b, files.b}, "3 files for 2 images");
  refused({"7=" + files.a}, "image 3 has no calibration");
  refused({"7=" + files.a, files.b}, "has no image id in front");
  refused({"7=" + files.a, "7=" + files.b}, "image 7 has two");
}

}  // namespace vantage::test
