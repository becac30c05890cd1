#include "metrics/reconstruction/perturbation.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "support/expect_error.hpp"

namespace vantage {
namespace {

constexpr std::size_t kCount = 4000;

std::vector<FeatureKey> keys_of(int count) {
  std::vector<FeatureKey> keys{{"keypoint", "spout"}};
  for (int id = 0; id < count; ++id) keys.push_back({"aruco", "4X4/" + std::to_string(id)});
  return keys;
}

/// One camera that sees marker 7 over and over.
std::vector<CameraView> one_view() {
  CameraView view{"0", Lens({640, 480, 600, 600, 320, 240}, {})};
  for (std::size_t i = 0; i < kCount; ++i) {
    view.observations.push_back(
        {{"aruco", "4X4/7"}, SeenPoints{{{1, 2}, {3, 2}, {3, 4}, {1, 4}}, 0.3}});
  }
  return {view};
}

std::vector<CameraView> disturb(const Perturbation& perturbation, std::uint64_t trial = 0) {
  return disturbed(one_view(), perturbation, trial, keys_of(50));
}

}  // namespace

TEST_CASE("no disturbance leaves everything as it was") {
  const auto views = disturb({});
  REQUIRE(views[0].observations.size() == kCount);
  for (const Observation& seen : views[0].observations) {
    CHECK(seen.key.value == "4X4/7");
    CHECK(std::get<SeenPoints>(seen.data).pixels[2] == Eigen::Vector2d(3, 4));
    CHECK(std::get<SeenPoints>(seen.data).sigma_px == 0.3);
  }
}

TEST_CASE("a share of the observations is lost, and a share misread as another id") {
  const auto views = disturb({.drop = 0.2, .wrong_ids = 0.05});
  const double left = double(views[0].observations.size());
  CHECK(std::abs(left / kCount - 0.8) < 4 * std::sqrt(0.2 * 0.8 / kCount));
  double wrong = 0;
  std::set<FeatureKey> wrong_keys;
  for (const Observation& seen : views[0].observations) {
    if (seen.key.value == "4X4/7") continue;
    ++wrong;
    wrong_keys.insert(seen.key);
    CHECK(seen.key.type == "aruco");  // a marker is no spout
  }
  CHECK(std::abs(wrong / left - 0.05) < 4 * std::sqrt(0.05 * 0.95 / left));
  CHECK(wrong_keys.size() > 30);  // of 49
}

TEST_CASE("noise is normal, and the observations say how large it is") {
  const auto views = disturb({.noise_px = 0.4});
  double sum = 0, squares = 0;
  for (const Observation& seen : views[0].observations) {
    const auto& points = std::get<SeenPoints>(seen.data);
    CHECK(points.sigma_px == doctest::Approx(0.5));  // 0.3 and 0.4 together
    for (const double off : {points.pixels[1].x() - 3, points.pixels[3].y() - 4}) {
      sum += off;
      squares += off * off;
    }
  }
  CHECK(std::abs(sum / (2 * kCount)) < 4 * 0.4 / std::sqrt(2.0 * kCount));
  CHECK(std::abs(std::sqrt(squares / (2 * kCount)) - 0.4) < 0.02);
}

TEST_CASE("seeds and trials differ, each the same every time") {
  const auto first_x = [](std::uint64_t seed, std::uint64_t trial) {
    const auto views = disturb({.noise_px = 1, .seed = seed}, trial);
    return std::get<SeenPoints>(views[0].observations[0].data).pixels[0].x();
  };
  CHECK(first_x(1, 0) == first_x(1, 0));
  CHECK(first_x(1, 0) != first_x(1, 1));
  CHECK(first_x(1, 0) != first_x(2, 0));
}

TEST_CASE("without another key of its type an observation keeps its own") {
  const std::vector<FeatureKey> keys{{"aruco", "4X4/7"}, {"keypoint", "spout"}};
  const auto views = disturbed(one_view(), {.wrong_ids = 1}, 0, keys);
  CHECK(views[0].observations.back().key == FeatureKey{"aruco", "4X4/7"});
}

TEST_CASE("disturbances that make no sense are refused") {
  const auto refused = [](const Perturbation& perturbation, const char* where, const char* what) {
    test::expect_bad_input(where, what, [&] { disturb(perturbation); });
  };
  refused({.noise_px = -1}, "noise_px", "found -1");
  refused({.noise_px = std::nan("")}, "noise_px", "found nan");
  refused({.drop = 1.5}, "drop", "found 1.5; expected a share from 0 to 1");
  refused({.wrong_ids = -0.1}, "wrong_ids", "found -0.1");
}

}  // namespace vantage
