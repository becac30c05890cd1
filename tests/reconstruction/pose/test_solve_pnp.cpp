#include "pose/solve_pnp.hpp"

#include <doctest/doctest.h>

#include "reconstruction/seen_board.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

using reconstruction::detail::PoseGuess;
using reconstruction::detail::solve_pnp;

struct SeenPointsOfBody {
  Pose T_cam_body;
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;

  SeenPointsOfBody(const Lens& lens, const Pose& pose, std::vector<Eigen::Vector3d> on_body,
                   double sigma_px, Random& random)
      : T_cam_body(pose), points(on_body) {
    pixels = seen_marker(lens, pose, {}, std::move(on_body), sigma_px, random).pixels;
  }
  std::vector<PoseGuess> guesses(const Lens& lens) const { return solve_pnp(lens, points, pixels); }
};

/// Of all guesses, how far the closest one is from the truth.
double closest(const std::vector<PoseGuess>& guesses, const Pose& truth) {
  double least = INFINITY;
  for (const PoseGuess& g : guesses) least = std::min(least, pose_distance(g.T_cam_body, truth));
  return least;
}

/// A body's pose in a camera half a metre above it.
Pose seen_from_above(Random& random) {
  return camera_above(0.5, random.uniform(0, 0.9), random).inverse();
}

}  // namespace

TEST_CASE("exact corners of a marker anywhere on a body give its pose, best first") {
  Random random(31);
  for (std::uint32_t scene = 0; scene < scene_count(200); ++scene) {
    CAPTURE(scene);
    const Lens& lens = some_lenses()[scene % some_lenses().size()];
    const Pose T_body_marker = random.pose(1);
    const Pose pose = seen_from_above(random) * T_body_marker.inverse();
    const SeenPointsOfBody seen(lens, pose, marker_corners(0.05, T_body_marker), 0, random);
    const auto guesses = seen.guesses(lens);
    REQUIRE(!guesses.empty());
    CHECK(guesses.size() <= 2);
    CHECK(pose_distance(guesses[0].T_cam_body, pose) < 1e-6);
    CHECK(guesses[0].rms_px < 1e-6);
    for (std::size_t i = 1; i < guesses.size(); ++i) {
      CHECK(guesses[i].rms_px >= guesses[i - 1].rms_px);
    }
  }
}

TEST_CASE("a marker far away has two poses, mirror images of each other") {
  Random random(32);
  for (std::uint32_t scene = 0; scene < scene_count(50); ++scene) {
    const Lens& lens = some_lenses()[0];
    const Pose pose = camera_above(2, 0.6, random).inverse();
    const SeenPointsOfBody seen(lens, pose, marker_corners(0.05, {}), 0, random);
    const auto guesses = seen.guesses(lens);
    REQUIRE(guesses.size() == 2);
    CHECK(guesses[1].rms_px < 0.2);
    CHECK(turn_between(guesses[0].T_cam_body, guesses[1].T_cam_body) > 0.5);
    // Both normals make nearly the same angle with the line of sight.
    const Eigen::Vector3d sight = pose.translation().normalized();
    const auto slant = [&](const PoseGuess& g) {
      return std::acos(std::abs(g.T_cam_body.rotation().col(2).dot(sight)));
    };
    CHECK(std::abs(slant(guesses[0]) - slant(guesses[1])) < 0.05);
  }
}

TEST_CASE("three points have the true pose among their poses, many points have it alone") {
  Random random(33);
  for (std::uint32_t scene = 0; scene < scene_count(100); ++scene) {
    CAPTURE(scene);
    const Lens& lens = some_lenses()[scene % some_lenses().size()];
    const Pose pose = seen_from_above(random);
    std::vector<Eigen::Vector3d> points;
    const std::size_t count = scene % 2 ? 3 : 6 + random.below(10);
    while (points.size() < count) points.push_back(random.in_cube(0.1));
    const SeenPointsOfBody seen(lens, pose, points, 0, random);
    const auto guesses = seen.guesses(lens);
    REQUIRE(!guesses.empty());
    CHECK(closest(guesses, pose) < 1e-5);
    if (count > 3) CHECK(pose_distance(guesses[0].T_cam_body, pose) < 1e-5);
    CHECK(guesses.size() <= 4);
  }
}

TEST_CASE("the same points have the same guesses, to the bit") {
  Random random(34);
  const Lens& lens = some_lenses()[1];
  const SeenPointsOfBody seen(lens, seen_from_above(random), marker_corners(0.05, {}), 0.3, random);
  const auto a = seen.guesses(lens), b = seen.guesses(lens);
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    CHECK(a[i].T_cam_body.rotation() == b[i].T_cam_body.rotation());
    CHECK(a[i].T_cam_body.translation() == b[i].T_cam_body.translation());
  }
}

TEST_CASE("no pose for too few points, collinear ones, and what is not finite") {
  Random random(35);
  const Lens& lens = some_lenses()[1];
  const SeenPointsOfBody good(lens, seen_from_above(random), marker_corners(0.05, {}), 0, random);
  REQUIRE(!good.guesses(lens).empty());
  const auto none = [&](const auto& spoil) {
    SeenPointsOfBody seen = good;
    spoil(seen);
    CHECK(seen.guesses(lens).empty());
  };
  none([](auto& s) { s.points.clear(), s.pixels.clear(); });
  none([](auto& s) { s.points.resize(2), s.pixels.resize(2); });
  none([](auto& s) { s.pixels.pop_back(); });
  none([](auto& s) { s.pixels[1].x() = std::nan(""); });
  none([](auto& s) { s.points[1].z() = INFINITY; });
  none([](auto& s) { s.pixels.assign(4, {100, 100}); });
  none([](auto& s) { s.points.assign(4, {1, 2, 3}); });
  none([](auto& s) {
    for (std::size_t i = 0; i < 4; ++i) s.points[i] = Eigen::Vector3d(0.1, 0.2, -0.3) * double(i);
  });
  none([](auto& s) {
    for (std::size_t i = 0; i < 4; ++i)
      s.pixels[i] = {100 + 10.0 * double(i), 50 + 20.0 * double(i)};
  });
  none([](auto& s) { s.pixels[2] = {1e9, -1e9}; });  // the lens has nothing there
}

}  // namespace vantage::test
