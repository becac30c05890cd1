// The library's marker detector against photographs whose truth is known to the last digit.

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "support/board_picture.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"
#include "vantage/reconstruction/detector.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

const Intrinsics kBoardIntrinsics{400, 300, 380, 380, 199.5, 149.5};

/// Three by two markers, turned, 80 mm apart.
PrintedBoard board_of(const std::string& dictionary, double size_m) {
  PrintedBoard board;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Matrix3d turned =
        Eigen::AngleAxisd(0.7 * i, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    board.markers.push_back(
        {dictionary, 3 * i + 1, size_m,
         Pose::from_rotation(turned, {0.08 * (i % 3) - 0.08, 0.08 * (i / 3) - 0.04, 0})});
  }
  return board;
}

/// How far the corners found are from where they are.
struct CornerErrors {
  int markers = 0, corners = 0, found = 0;
  double sum_squared = 0, normalised = 0, worst = 0;

  void compare(const PrintedBoard& board, const Lens& lens, const Pose& T_world_cam,
               const std::vector<Observation>& seen) {
    for (const Marker& marker : board.markers) {
      ++markers;
      for (const Observation& observation : seen) {
        if (observation.key != marker_key(marker.dictionary, marker.id)) continue;
        ++found;
        const auto& points = std::get<SeenPoints>(observation.data);
        for (std::size_t c = 0; c < 4; ++c) {
          const Eigen::Vector2d truth = pixel_of(lens, T_world_cam, marker.corners()[c]);
          const double error = (points.pixels.at(c) - truth).norm();
          ++corners;
          sum_squared += error * error;
          normalised += error * error / (2 * points.sigma_px * points.sigma_px);
          worst = std::max(worst, error);
        }
      }
    }
  }
  double rms() const { return std::sqrt(sum_squared / corners); }
};

struct Camera {
  Distortion distortion = {};
  double gamma = 0;  // sRGB
  bool knows_lens = false;
  double noise = 0;  // codes
};

CornerErrors look(const PrintedBoard& board, const Camera& camera) {
  const Lens lens(kBoardIntrinsics, camera.distortion);
  ArucoOptions options{{board.markers[0].dictionary}, {}};
  if (camera.knows_lens) options.lens = lens;
  const ArucoDetector detector(options);
  CornerErrors errors;
  std::vector<Eigen::Vector3d> eyes{{0.02, -0.1, 0.3}, {-0.22, -0.12, 0.25}};
  eyes.resize(scene_count(2));
  for (const Eigen::Vector3d& eye : eyes) {
    const Pose T_world_cam = Pose::looking_at(eye, {0, 0, 0});
    ColorImage image = BoardCamera(board, lens, T_world_cam).photograph(camera.gamma);
    std::mt19937 random(5);
    for (std::uint8_t& sample : image.samples) {  // even noise from -√3 to √3 sigmas
      const double noise = camera.noise * 3.4641 * (double(random()) / 4294967296.0 - 0.5);
      sample = std::uint8_t(std::clamp(std::lround(sample + noise), 0l, 255l));
    }
    errors.compare(board, lens, T_world_cam, detector.detect(image));
  }
  return errors;
}

}  // namespace

TEST_CASE("corners are right to hundredths of a pixel, and the detector knows how well" *
          doctest::skip(kSanitized)) {
  std::vector<const char*> dictionaries{"4X4_50", "6X6_250", "APRILTAG_36h11"};
  dictionaries.resize(scene_count(3));
  for (const char* dictionary : dictionaries) {
    CAPTURE(dictionary);
    for (const double noise : {0.0, 3.0}) {
      if (noise > 0 && dictionary[0] != '4') continue;  // one is enough
      CAPTURE(noise);
      Camera camera;
      camera.noise = noise;
      const CornerErrors errors = look(board_of(dictionary, 0.04), camera);
      CHECK(errors.found == errors.markers);
      CHECK(errors.rms() < 0.06);
      CHECK(errors.worst < 0.25);
      // Its mean is 1 where sigma_px is true.
      const double normalised = errors.normalised / errors.corners;
      CHECK(normalised > 0.3);
      CHECK(normalised < 2.5);
    }
  }
}

TEST_CASE("another gamma than sRGB's and ink that has run do not move the corners" *
          doctest::skip(kSanitized)) {
  Camera camera;
  camera.gamma = 1.2;
  CHECK(look(board_of("4X4_50", 0.04), camera).rms() < 0.07);
  PrintedBoard inky = board_of("4X4_50", 0.04);
  inky.ink_m = 0.0003;  // half a pixel
  CHECK(look(inky, {}).rms() < 0.2);
}

TEST_CASE("through a fisheye lens, corners are right if the detector knows it" *
          doctest::skip(kSanitized)) {
  Camera camera;
  camera.distortion = Distortion::fisheye(0.1, -0.05, 0.02, -0.004);
  const PrintedBoard board = board_of("4X4_50", 0.05);
  const CornerErrors unknowing = look(board, camera);
  camera.knows_lens = true;
  const CornerErrors knowing = look(board, camera);
  CHECK(knowing.found == knowing.markers);
  CHECK(knowing.rms() < 0.06);
  CHECK(knowing.worst < 0.25);
  CHECK(unknowing.rms() > 1.1 * knowing.rms());
}

TEST_CASE("white markers on black are found as black ones on white are") {
  const PrintedBoard board = board_of("4X4_50", 0.04);
  const Lens lens(kBoardIntrinsics, {});
  const Pose T_world_cam = Pose::looking_at({0.02, -0.1, 0.3}, {0, 0, 0});
  ColorImage image = BoardCamera(board, lens, T_world_cam).photograph(0);
  CornerErrors usual, inverted;
  const ArucoDetector detector({{"4X4_50"}, lens});
  usual.compare(board, lens, T_world_cam, detector.detect(image));
  // The negative of the light, not of its codes: edges stay where they are.
  for (std::uint8_t& sample : image.samples) {
    const double c = sample / 255.0;
    const double light = 1 - (c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    const double code =
        light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
    sample = std::uint8_t(std::lround(255 * code));
  }
  inverted.compare(board, lens, T_world_cam, detector.detect(image));
  CHECK(usual.found == usual.markers);
  CHECK(inverted.found == inverted.markers);
  CHECK(inverted.rms() < 0.1);
}

TEST_CASE("markers in faint light are found, too" * doctest::skip(kSanitized)) {
  const PrintedBoard board = board_of("4X4_50", 0.04);
  const Lens lens(kBoardIntrinsics, {});
  const Pose T_world_cam = Pose::looking_at({0.02, -0.1, 0.3}, {0, 0, 0});
  ColorImage image = BoardCamera(board, lens, T_world_cam).photograph(0);
  // Black is 22 codes darker than white, and 11 darker than the mean at its edge: less than the 15
  // that the strict outlines ask for, more than the usual 7.
  for (std::uint8_t& sample : image.samples) sample = std::uint8_t(150 + sample * 22 / 255);
  std::vector<Observation> seen = ArucoDetector({{"4X4_50"}, lens}).detect(image);
  CHECK(seen.size() == board.markers.size());
}

TEST_CASE("through a strong lens, corners are right if the detector knows it") {
  Camera camera;
  camera.distortion.k1 = -0.25;
  camera.distortion.k2 = 0.08;
  const PrintedBoard board = board_of("4X4_50", 0.05);
  const double without = look(board, camera).rms();
  camera.knows_lens = true;
  const CornerErrors with = look(board, camera);
  CHECK(with.found == with.markers);
  CHECK(with.rms() < 0.06);
  CHECK(with.rms() < without / 2);
}

TEST_CASE("something dark beside a marker does not drag its corners along" *
          doctest::skip(kSanitized)) {
  std::vector<double> gaps{0.003, 0.0, 0.001};
  gaps.resize(scene_count(3));
  for (const double gap : gaps) {
    CAPTURE(gap);
    PrintedBoard board;
    for (int i = 0; i < 6; ++i) {
      const double x = 0.08 * (i % 3) - 0.08, y = 0.08 * (i / 3) - 0.04;
      board.markers.push_back({"4X4_50", i, 0.04, Pose::from_translation({x, y, 0})});
      board.stripes.push_back({x + 0.02 + gap, y - 0.035, x + 0.035, y + 0.035, 0.03});
    }
    // A marker without white beside it need not be found; none may be wrong.
    const CornerErrors errors = look(board, {});
    CHECK(errors.found >= (gap > 0.002 ? errors.markers : 0));
    CHECK(errors.worst < 0.5);
  }
}

TEST_CASE("a half covered marker is not detected") {
  PrintedBoard board = board_of("4X4_50", 0.04);
  board.stripes.push_back({-0.2, -0.04, 0.2, 0.04, 0.3});  // over half of each
  CHECK(look(board, {}).found == 0);
}

TEST_CASE("several dictionaries at once, sorted by key and then from left to right") {
  PrintedBoard board = board_of("4X4_50", 0.04);
  board.markers[0].dictionary = "5X5_100";
  board.markers[4].id = board.markers[2].id;
  const Lens lens(kBoardIntrinsics, {});
  const ColorImage image =
      BoardCamera(board, lens, Pose::looking_at({0, -0.05, 0.3}, {0, 0, 0})).photograph();
  const auto seen = ArucoDetector({{"5X5_100", "4X4_50"}, {}}).detect(image);
  REQUIRE(seen.size() == 6);
  CHECK(seen.back().key == marker_key("5X5_100", 1));
  int twins = 0;
  for (std::size_t i = 1; i < seen.size(); ++i) {
    CHECK(seen[i - 1].key <= seen[i].key);
    if (seen[i - 1].key != seen[i].key) continue;
    ++twins;
    CHECK(std::get<SeenPoints>(seen[i - 1].data).pixels[0].x() <
          std::get<SeenPoints>(seen[i].data).pixels[0].x());
  }
  CHECK(twins == 1);
  for (const Observation& observation : seen) CHECK(fault_of(observation).empty());
}

TEST_CASE("there are no markers where there is nothing to see") {
  const ArucoDetector detector({{"4X4_50", "6X6_250"}, {}});
  CHECK(detector.detect(ColorImage()).empty());
  for (const auto& [width, height] : {std::pair(1, 1), {3, 200}, {200, 3}, {16, 16}, {300, 200}}) {
    for (const int code : {0, 128, 255}) {
      CHECK(detector.detect(ColorImage(width, height, std::uint8_t(code))).empty());
    }
  }
  ColorImage noise(320, 240);
  std::mt19937 random(3);
  for (std::uint8_t& sample : noise.samples) sample = std::uint8_t(random() >> 24);
  CHECK(detector.detect(noise).empty());
}

TEST_CASE("dictionaries that there are not, and an image of another camera, are refused") {
  expect_bad_input("dictionaries", "'4X4_51'", [] { ArucoDetector({{"4X4_51"}, {}}); });
  expect_bad_input("dictionaries", "there is no dictionary", [] { ArucoDetector({{}, {}}); });
  expect_bad_input("dictionaries", "the larger one", [] {
    ArucoDetector({{"4X4_50", "4X4_250"}, {}});
  });
  const ArucoDetector detector({{"4X4_50"}, Lens(kBoardIntrinsics, {})});
  expect_bad_input("image", "expected the lens' 400 x 300",
                   [&] { detector.detect(ColorImage(640, 480)); });
}
