#include <doctest/doctest.h>
#include <fmt/format.h>

#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "vantage/reconstruction/calibration.hpp"

namespace vantage::test {
namespace {

std::string matrix(const std::string& key, int rows, int columns, const std::string& numbers) {
  return fmt::format("{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ {} ]\n",
                     key, rows, columns, numbers);
}

const std::string kSizeLines = "image_width: 640\nimage_height: 480\n";
const std::string kCameraLines =
    matrix("camera_matrix", 3, 3, "615., 0., 322.3, 0., 611., 238.1, 0., 0., 1.");
const std::string kLensLines =
    matrix("distortion_coefficients", 5, 1, "0.1, -0.05, 0.001, -0.002, 0.01");

/// Reads a file with these parts.
Lens read(const std::string& text, int width = 0, int height = 0) {
  const TemporaryFolder folder;
  return read_calibration(folder.write("camera.yml", "%YAML:1.0\n---\n" + text), width, height);
}

void expect_calibration_refused(const std::string& text, std::string_view where_end,
                                std::initializer_list<std::string_view> parts, int width = 0,
                                int height = 0) {
  CAPTURE(text);
  expect_refused([&] { read(text, width, height); }, where_end, parts);
}

}  // namespace

TEST_CASE("calibrations of OpenCV's tools are read: rows and columns of 4, 5 and 8 coefficients") {
  const Lens lens = read(kSizeLines + kCameraLines + kLensLines, 640, 480);
  CHECK(lens.intrinsics() == Intrinsics{640, 480, 615, 611, 322.3, 238.1});
  CHECK(lens.distortion() == Distortion{0.1, -0.05, 0.001, -0.002, 0.01});
  const std::string key = "distortion_coefficients";
  const std::string eight = "0.3, 0.05, 0.001, 0, 0.01, 0.35, 0.02, 0.005";
  const Distortion rational{0.3, 0.05, 0.001, 0, 0.01, 0.35, 0.02, 0.005};
  CHECK(read(kSizeLines + kCameraLines + matrix(key, 1, 4, "0.1, 0, 0, 0.002")).distortion() ==
        Distortion{0.1, 0, 0, 0.002});
  CHECK(read(kSizeLines + kCameraLines + matrix(key, 1, 8, eight)).distortion() == rational);
  CHECK(read(kSizeLines + kCameraLines + matrix(key, 12, 1, eight + ", 0, 0, 0, 0")).distortion() ==
        rational);
  CHECK(read(kSizeLines + kCameraLines + matrix(key, 1, 14, eight + ", 0, 0, 0, 0, 0, 0"))
            .distortion() == rational);
  CHECK(read(kCameraLines + kLensLines, 640, 480).intrinsics() == lens.intrinsics());
}

TEST_CASE("the same in XML") {
  const TemporaryFolder folder;
  const auto file = folder.write(
      "camera.xml",
      "<?xml version=\"1.0\"?>\n<opencv_storage>\n<image_width>640</image_width>\n"
      "<image_height>480</image_height>\n<camera_matrix type_id=\"opencv-matrix\">\n"
      "<rows>3</rows><cols>3</cols><dt>d</dt>\n<data>615. 0. 322.3 0. 611. 238.1 0. 0. 1.</data>"
      "</camera_matrix>\n<distortion_coefficients type_id=\"opencv-matrix\">\n<rows>1</rows>"
      "<cols>4</cols><dt>f</dt><data>0.5 0. 0. 0.</data></distortion_coefficients>\n"
      "</opencv_storage>\n");
  const Lens lens = read_calibration(file);
  CHECK(lens.intrinsics() == Intrinsics{640, 480, 615, 611, 322.3, 238.1});
  CHECK(lens.distortion() == Distortion{0.5});
}

TEST_CASE("the calibration of the printed board's camera is a lens") {
  const auto folder = recording("charuco");
  if (!folder) return;
  const Lens lens = read_calibration(*folder / "camera.yml", 640, 480);
  CHECK(lens.intrinsics().fx == doctest::Approx(452.51072219637672));
  CHECK(lens.intrinsics().cy == doctest::Approx(277.75155919135995));
  CHECK(lens.distortion().k3 == doctest::Approx(2.9542589406810080));
}

TEST_CASE("what is missing, of the wrong size or no number is refused with its place") {
  expect_calibration_refused(kSizeLines + kLensLines, "camera.yml: camera_matrix",
                             {"missing", "3 × 3"});
  expect_calibration_refused(kSizeLines + kCameraLines, ": distortion_coefficients",
                             {"missing", "4, 5 or 8"});
  expect_calibration_refused(kCameraLines + kLensLines, ": image_width",
                             {"missing", "there is no image to take it from"});
  expect_calibration_refused(kSizeLines + kCameraLines + kLensLines, ": image_width",
                             {"640", "the images have 1280"}, 1280, 960);
  expect_calibration_refused("image_width: wide\nimage_height: 3\n" + kCameraLines + kLensLines,
                             ": image_width", {"a whole number of pixels"});
  expect_calibration_refused("image_width: 0\nimage_height: 3\n" + kCameraLines + kLensLines,
                             ": camera_matrix", {"width is 0"});
  expect_calibration_refused(kSizeLines + kLensLines + "camera_matrix: [ 1, 2, 3 ]\n",
                             ": camera_matrix", {"1 × 3 numbers", "3 × 3"});
  const auto camera = [](const std::string& numbers) {
    return kSizeLines + kLensLines + matrix("camera_matrix", 3, 3, numbers);
  };
  expect_calibration_refused(camera("615., 0., 322.3, 0., 611., 238.1"), ": camera_matrix",
                             {"not a matrix", "6 numbers for 3 × 3"});
  expect_calibration_refused(camera("615., 0.5, 322.3, 0., 611., 238.1, 0., 0., 1."),
                             ": camera_matrix", {"skewed by 0.5", "expected 0"});
  expect_calibration_refused(camera("615., 0., 322.3, 0., 611., 238.1, 0., 0., 2."),
                             ": camera_matrix", {"expected [fx, 0, cx, 0, fy, cy, 0, 0, 1]"});
  expect_calibration_refused(camera("615., 0., .Nan, 0., 611., 238.1, 0., 0., 1."),
                             ": camera_matrix", {"nan", "finite"});
  expect_calibration_refused(camera("-615., 0., 3., 0., 611., 238.1, 0., 0., 1."),
                             ": camera_matrix", {"-615"});
  expect_calibration_refused(
      kSizeLines + kLensLines + matrix("camera_matrix", 2, 2, "1., 2., 3., 4."), ": camera_matrix",
      {"2 × 2"});
  expect_calibration_refused(kSizeLines + kLensLines + matrix("camera_matrix", 99999, 99999, "1."),
                             ": camera_matrix", {"99999 × 99999"});
  const auto lens = [](int count, const std::string& numbers) {
    return kSizeLines + kCameraLines + matrix("distortion_coefficients", 1, count, numbers);
  };
  expect_calibration_refused(lens(3, "0., 0., 0."), ": distortion_coefficients",
                             {"1 × 3", "4, 5 or 8"});
  expect_calibration_refused(lens(12, "0., 0., 0., 0., 0., 0., 0., 0., 0., 0.25, 0., 0."),
                             ": distortion_coefficients",
                             {"coefficient 10 of 12 is 0.25", "CALIB_THIN_PRISM_MODEL"});
  expect_calibration_refused(lens(4, "-2., 0., 0., 0."), ": distortion_coefficients",
                             {"folds over"});
  expect_calibration_refused(lens(4, ".Inf, 0., 0., 0."), ": distortion_coefficients",
                             {"inf", "finite"});
}

TEST_CASE("files that are not calibrations are refused, wherever they end") {
  const TemporaryFolder folder;
  const auto refused = [&](std::string_view bytes, std::string_view message) {
    const auto file = folder.write("camera.yml", bytes);
    expect_bad_input("camera.yml", message, [&] { read_calibration(file); });
  };
  refused("", "empty");
  refused("\x89PNG\r\n", "");
  refused("{\"camera_matrix\": 3}", "there is no image to take it from");
  refused("%YAML:1.0\n---\na: [ 1, 2\nb: }\n", "invalid YAML");
  refused("<?xml version=\"1.0\"?>\n<other>\n", "invalid or truncated XML");
  refused("<?xml version=\"1.0\"?>\n<other></other>\n", "its root is <other>");
  refused("%YAML:1.0\n---\na: 1\n", "3 × 3 numbers, as OpenCV writes them");
  expect_bad_input("none.yml", "", [&] { read_calibration(folder / "none.yml"); });

  const std::string whole = "%YAML:1.0\n---\n" + kSizeLines + kCameraLines + kLensLines;
  std::size_t count = 0;
  for (std::size_t end = 0; end + 30 < whole.size(); ++end) {
    const auto file = folder.write("cut.yml", whole.substr(0, end));
    CAPTURE(end);
    if (caught([&] { read_calibration(file); })) ++count;
  }
  CHECK(count == whole.size() - 30);
}

}  // namespace vantage::test
