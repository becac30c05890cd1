// How often the detector finds markers in pictures, and what the table says of it.

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulator/color_scenes.hpp"
#include "simulator/markers/marker_print.hpp"
#include "simulator/scene/sample_hash.hpp"
#include "vantage/reconstruction/detector.hpp"
#include "vantage/reconstruction/detector_recall.hpp"

namespace vantage::test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMarkerM = 0.04, kPlateM = 0.07;

/// A plate with a marker on top, turned about z, seen from above at an angle. The picture is no
/// larger than it has to be.
ColorImage picture_of_marker(int id, double side_px, double angle, std::uint64_t seed) {
  const Marker marker{"4X4_250", id, kMarkerM, Pose::from_translation({0, 0, 0})};
  const TriangleMesh plate = TriangleMesh::from_box(
      Box({-kPlateM / 2, -kPlateM / 2, -0.01}, {kPlateM / 2, kPlateM / 2, 0}));
  const auto shape = std::make_shared<const TexturedMesh>(
      with_markers(plate, {0.7f, 0.6f, 0.5f}, std::vector{marker}, "plate"));
  const double turn = 2 * std::numbers::pi * to_unit(sample_hash(seed, 0));
  const Pose T_world_plate = Pose::from_rotation(
      Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).toRotationMatrix(), {0, 0, 0});
  const SimulatedScene scene({{"plate", shape, T_world_plate}});
  const double focal = 615, distance = focal * kMarkerM / side_px;
  const Eigen::Vector3d eye(distance * std::sin(angle), 0, distance * std::cos(angle));
  const int size = 4 * int(side_px / 2 + 12);
  const PinholeCamera camera({size, size, focal, focal, size / 2 + to_unit(sample_hash(seed, 1)),
                              size / 2 + to_unit(sample_hash(seed, 2))},
                             Pose::looking_at(eye, {0, 0, 0}));
  return *simulate_color(scene, {}, camera, {.read_noise = 0.004, .shot_noise = 2e-4}, seed);
}

int found_of(int trials, double side_px, double angle_deg, std::uint64_t seed) {
  const ArucoDetector detector({.dictionaries = {"4X4_250"}});
  int found = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const int id = int(sample_hash(seed, trial) % 250);
    const auto seen = detector.detect(
        picture_of_marker(id, side_px, angle_deg * kDegree, sample_hash(seed, trial, 1)));
    found += std::ranges::any_of(
        seen, [&](const Observation& o) { return o.key == marker_key("4X4_250", id); });
  }
  return found;
}

}  // namespace

TEST_CASE("the whole table of the detector's recall, measured anew" * doctest::skip()) {
  for (const double side : {8, 10, 12, 14, 16, 20, 24, 32, 48}) {
    std::string row;
    for (const double angle : {0, 30, 45, 60, 70, 75, 80, 85}) {
      const int found = found_of(20, side, angle, sample_hash(7, side, angle));
      CHECK(found / 20.0 == doctest::Approx(detector_recall(side, angle * kDegree)));
      row += fmt::format("{}, ", found);
    }
    MESSAGE("{" << row << "} " << side << " px");
  }
}

TEST_CASE("the detector finds as many markers as the table says" * doctest::test_suite("slow")) {
  constexpr int kTrials = 30;
  const struct {
    double side_px, angle_deg;
  } cells[] = {{9, 0}, {11, 20}, {13, 40}, {15, 60}, {18, 65}, {22, 72}, {28, 50}, {40, 78}};
  for (const auto& cell : cells) {
    const double side_px = cell.side_px, angle_deg = cell.angle_deg;
    CAPTURE(side_px);
    CAPTURE(angle_deg);
    const double recall = detector_recall(side_px, angle_deg * kDegree);
    const double measured = found_of(kTrials, side_px, angle_deg, 99) / double(kTrials);
    CHECK(std::abs(measured - recall) <= 0.3);
  }
}

TEST_CASE("recall grows with size, and nothing is found that is turned away") {
  const auto at = [](double side_px, double angle_deg) {
    return detector_recall(side_px, angle_deg * kDegree);
  };
  CHECK(at(60, 0) == 1);
  CHECK(at(40, 10) > 0.95);
  CHECK(at(5, 0) == 0);
  CHECK(at(48, 86) == 0);
  CHECK(at(16, 30) >= at(10, 30));
  CHECK(at(24, 45) == doctest::Approx((at(24, 45 - 1e-9) + at(24, 45 + 1e-9)) / 2));
}

}  // namespace vantage::test
