#include <doctest/doctest.h>

#include <chrono>
#include <string>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "vantage/reconstruction/calibration.hpp"

namespace vantage::test {
namespace {

const Intrinsics kCalibrated{640, 480, 615, 611, 322.3, 238.1};

Lens read_as(const std::string& name, const std::string& text, const std::string& camera = "",
             int width = 0, int height = 0) {
  const TemporaryFolder folder;
  const auto file = folder.write(name, text);
  return read_calibration(camera.empty() ? file.string() : file.string() + "#" + camera, width,
                          height);
}

const std::string kRosHead =
    "image_width: 640\nimage_height: 480\ncamera_name: cam\ncamera_matrix:\n  rows: 3\n  cols: 3\n"
    "  data: [615.0, 0.0, 322.3, 0.0, 611.0, 238.1, 0.0, 0.0, 1.0]\n";

std::string ros(const std::string& model, const std::string& numbers, int count) {
  return kRosHead + "distortion_model: " + model +
         "\ndistortion_coefficients:\n  rows: 1\n  cols: " + std::to_string(count) + "\n  data: [" +
         numbers + "]\n";
}

const std::string kKalibr =
    "cam0:\n  camera_model: pinhole\n  intrinsics: [615, 611, 322.3, 238.1]\n"
    "  distortion_model: radtan\n  distortion_coeffs: [0.1, -0.05, 0.001, -0.002]\n"
    "  resolution: [640, 480]\n  rostopic: /cam0/image_raw\n"
    "cam1:\n  camera_model: pinhole\n  intrinsics: [600, 600, 320, 240]\n"
    "  T_cn_cnm1:\n  - [1.0, 0.0, 0.0, 0.1]\n  distortion_model: equidistant\n"
    "  distortion_coeffs: [0.08, -0.02, 0.01, -0.003]\n  resolution: [640, 480]\n";

}  // namespace

TEST_CASE("OpenCV's fisheye flag makes a fisheye lens") {
  const std::string text =
      "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\nfisheye_model: 1\n"
      "camera_matrix: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
      "   data: [ 615., 0., 322.3, 0., 611.,\n       238.1, 0., 0., 1. ]\n"
      "distortion_coefficients: !!opencv-matrix\n   rows: 4\n   cols: 1\n   dt: d\n"
      "   data: [ 0.08, -0.02, 0.01, -0.003 ]\n";
  CHECK(read_as("camera.yml", text).distortion() == Distortion::fisheye(0.08, -0.02, 0.01, -0.003));
  std::string usual = text;
  usual.replace(usual.find("fisheye_model: 1"), 16, "fisheye_model: 0");
  CHECK(read_as("camera.yml", usual).distortion() == Distortion{0.08, -0.02, 0.01, -0.003});
}

TEST_CASE("what is written is read again") {
  for (const Distortion& d : {Distortion{}, Distortion{-0.28, 0.09, 0.001, -0.002, 0.01},
                              Distortion{0.3, 0.05, 0.001, 0, 0.01, 0.35, 0.02, 0.005},
                              Distortion::fisheye(0.08, -0.02, 0.01, -0.003)}) {
    const Lens lens = read_as("camera.yml", calibration_yaml(Lens(kCalibrated, d)));
    CHECK(lens.intrinsics() == kCalibrated);
    CHECK(lens.distortion() == d);
  }
}

TEST_CASE("calibrations of ROS: the model's name counts") {
  const Lens plumb = read_as("ost.yaml", ros("plumb_bob", "0.1, -0.05, 0.001, -0.002, 0.01", 5));
  CHECK(plumb.intrinsics() == kCalibrated);
  CHECK(plumb.distortion() == Distortion{0.1, -0.05, 0.001, -0.002, 0.01});
  CHECK(read_as("ost.yaml", ros("equidistant", "0.08, -0.02, 0.01, -0.003", 4)).distortion() ==
        Distortion::fisheye(0.08, -0.02, 0.01, -0.003));
  CHECK(read_as("ost.yaml",
                ros("rational_polynomial", "0.3, 0.05, 0.001, 0, 0.01, 0.35, 0.02, 0.005", 8))
            .distortion() == Distortion{0.3, 0.05, 0.001, 0, 0.01, 0.35, 0.02, 0.005});
  // The message camera_info, as `rostopic echo` and `ros2 topic echo` print it.
  const std::string message =
      "width: 640\nheight: 480\ndistortion_model: plumb_bob\n"
      "D: [0.1, -0.05, 0.001, -0.002, 0.01]\nK: [615.0, 0.0, 322.3, 0.0, 611.0, 238.1, 0, 0, 1]\n"
      "R: [1, 0, 0, 0, 1, 0, 0, 0, 1]\nbinning_x: 0\n";
  CHECK(read_as("info.yaml", message).distortion() == plumb.distortion());
  std::string ros2 = message;
  ros2.replace(ros2.find("\nD:"), 3, "\nd:");
  ros2.replace(ros2.find("\nK:"), 3, "\nk:");
  CHECK(read_as("info.yaml", ros2).intrinsics() == kCalibrated);
  std::string undistorted = message;
  undistorted.replace(undistorted.find("D: [0.1, -0.05, 0.001, -0.002, 0.01]"), 36, "D: []");
  CHECK(read_as("info.yaml", undistorted).distortion().none());
  std::string binned = message;
  binned.replace(binned.find("binning_x: 0"), 12, "binning_x: 2");
  expect_refused([&] { read_as("info.yaml", binned); }, "binning_x", {"found 2"});
}

TEST_CASE("models that we do not have are refused by their names") {
  expect_refused([] { read_as("a.yaml", ros("fov", "0.1, 0, 0, 0", 4)); }, "distortion_model",
                 {"\"fov\"", "plumb_bob", "equidistant"});
  expect_refused([] { read_as("a.yaml", ros("inverse_brown_conrady", "0.1, 0, 0, 0, 0", 5)); },
                 "distortion_model", {"RealSense"});
  CHECK(read_as("a.yaml", ros("inverse_brown_conrady", "0, 0, 0, 0, 0", 5)).distortion().none());
  expect_refused([] { read_as("a.yaml", ros("equidistant", "0.1, 0, 0, 0, 0", 5)); },
                 "distortion_coefficients", {"1 × 5", "four numbers of a fisheye lens"});
  std::string omni = kKalibr;
  omni.replace(omni.find("pinhole"), 7, "omni");
  expect_refused([&] { read_as("a.yaml", omni, "cam0"); }, "camera_model", {"\"omni\""});
}

TEST_CASE("Kalibr's chains have several cameras, of which one is named") {
  const Lens first = read_as("chain.yaml", kKalibr, "cam0");
  CHECK(first.intrinsics() == kCalibrated);
  CHECK(first.distortion() == Distortion{0.1, -0.05, 0.001, -0.002});
  CHECK(read_as("chain.yaml", kKalibr, "cam1").distortion() ==
        Distortion::fisheye(0.08, -0.02, 0.01, -0.003));
  expect_refused([] { read_as("chain.yaml", kKalibr); }, "chain.yaml",
                 {"several cameras", "cam0, cam1", "chain.yaml#cam0"});
  expect_refused([] { read_as("chain.yaml", kKalibr, "cam2"); }, "chain.yaml",
                 {"no camera \"cam2\"", "cam0, cam1"});
  // Without its second camera, the first one needs no name; and it may have no distortion.
  std::string one = kKalibr.substr(0, kKalibr.find("cam1"));
  CHECK(read_as("chain.yaml", one).distortion() == first.distortion());
  one.replace(one.find("radtan"), 6, "none");
  CHECK(read_as("chain.yaml", one).distortion().none());
  expect_refused([&] { read_as("chain.yaml", one, "", 1280, 960); }, "resolution", {"640", "1280"});
}

TEST_CASE("OpenCV's other keys and JSON") {
  const std::string k = "[615., 0., 322.3, 0., 611., 238.1, 0., 0., 1.]";
  const std::string stereo =
      "%YAML:1.0\n---\nM1: !!opencv-matrix\n   rows: 3\n   cols: 3\n"
      "   dt: d\n   data: " +
      k +
      "\nD1: !!opencv-matrix\n   rows: 1\n   cols: 5\n   dt: d\n"
      "   data: [ 0.1, -0.05, 0.001, -0.002, 0.01 ]\n";
  CHECK(read_as("intrinsics.yml", stereo, "", 640, 480).intrinsics() == kCalibrated);
  std::string both = stereo, second = stereo.substr(stereo.find("M1"));
  second.replace(second.find("M1"), 2, "M2");
  second.replace(second.find("D1"), 2, "D2");
  second.replace(second.find("0.1, -0.05"), 10, "0.2, -0.05");
  both += second;
  CHECK(read_as("intrinsics.yml", both, "2", 640, 480).distortion().k1 == 0.2);
  expect_refused([&] { read_as("intrinsics.yml", both, "", 640, 480); }, "intrinsics.yml",
                 {"several cameras", "1, 2"});
  const std::string json =
      R"({"camera_matrix": [[615, 0, 322.3], [0, 611, 238.1], [0, 0, 1]],)"
      R"( "dist_coeffs": [[0.1, -0.05, 0.001, -0.002, 0.01]], "image_size": [640, 480]})";
  CHECK(read_as("camera.json", json).intrinsics() == kCalibrated);
  CHECK(read_as("camera.json", json).distortion().k3 == 0.01);
  CHECK(read_as("camera.yaml", "cameraMatrix: " + k + "\ndistCoeffs: [0, 0, 0, 0]\n", "", 640, 480)
            .distortion()
            .none());
}

TEST_CASE("large calibrations are read, deep ones and long ones of nothing end at once") {
  std::string large = calibration_yaml(Lens(kCalibrated, {0.1})) + "image_points: [";
  while (large.size() < (3u << 20)) large += "123.456, 78.9,\n  ";
  CHECK(read_as("camera.yml", large + "1]\n").distortion() == Distortion{0.1});
  const auto start = std::chrono::steady_clock::now();
  for (const char* opening : {"[", "{a: ", "- "}) {
    std::string deep;
    for (int i = 0; i < 60'000; ++i) deep += opening;
    expect_refused([&] { read_as("deep.yml", deep); }, "", {});
    CHECK_THROWS_AS(read_as("deep.yml", "%YAML:1.0\n---\n" + deep), Error);
  }
  std::string xml = "<?xml version=\"1.0\"?>\n<opencv_storage>";
  for (int i = 0; i < 60'000; ++i) xml += "<a>";
  CHECK_THROWS_AS(read_as("deep.xml", xml), Error);
  for (int i = 0; i < 60'000; ++i) xml += "</a>";
  expect_refused([&] { read_as("deep.xml", xml + "</opencv_storage>"); }, "deep.xml",
                 {"deeper than 64"});
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(20));
}

}  // namespace vantage::test
