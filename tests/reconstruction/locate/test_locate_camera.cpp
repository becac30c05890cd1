#include <doctest/doctest.h>
#include <fmt/format.h>

#include <Eigen/Cholesky>

#include "reconstruction/seen_board.hpp"
#include "reference/plain_least_squares.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

/// Markers scattered within 15 cm.
SeenBoard scattered(int markers, Random& random) {
  SeenBoard board;
  for (int i = 0; i < markers; ++i) board.add_marker(i, 0.05, facing_up(0.15, random));
  return board;
}

CameraLocation locate(const SeenBoard& board, const Lens& lens = some_lenses()[0]) {
  return locate_camera(lens, board.observations, board.features);
}

}  // namespace

TEST_CASE("exact corners give the exact camera, for any layout and lens") {
  Random random(11);
  for (std::uint32_t scene = 0; scene < scene_count(60); ++scene) {
    CAPTURE(scene);
    SeenBoard board =
        scene % 2 ? scattered(2 + int(random.below(6)), random) : SeenBoard::grid(4, 3, 0.04, 0.06);
    const Lens& lens = some_lenses()[scene % some_lenses().size()];
    board.look(lens, camera_above(0.8, random.uniform(0.3, 0.7), random), 0, random);
    const CameraLocation found = locate(board, lens);
    CAPTURE(found.reason);
    REQUIRE(found.pose);
    CHECK(pose_distance(found.pose->T_world_cam, board.T_world_cam) < 1e-8);
    CHECK(found.inliers.size() == board.observations.size());
    CHECK(found.outliers.empty());
    CHECK(found.alternatives.empty());
  }
}

TEST_CASE("the covariance is true: the normalised error squared has the mean 6") {
  Random random(13);
  const std::uint32_t trials = scene_count(1000);
  double sum = 0;
  for (std::uint32_t trial = 0; trial < trials; ++trial) {
    SeenBoard board = trial % 2 ? scattered(6, random) : SeenBoard::grid(3, 3, 0.05, 0.08);
    const Lens& lens = some_lenses()[trial % some_lenses().size()];
    board.look(lens, camera_above(0.7, random.uniform(0.4, 0.7), random), 0.2, random);
    const CameraLocation found = locate(board, lens);
    CAPTURE(found.reason);
    REQUIRE(found.pose);
    const auto off = step_between(found.pose->T_world_cam, board.T_world_cam);
    sum += off.dot(found.pose->covariance.ldlt().solve(off));
  }
  // Of a chi-square distribution with 6 × trials degrees of freedom.
  const double half_interval = 1.96 * std::sqrt(2.0 * 6 * trials);
  MESSAGE("NEES ", sum / trials, ", expected 6 ± ", half_interval / trials);
  CHECK(std::abs(sum - 6.0 * trials) < half_interval);
}

TEST_CASE("more markers make the error smaller") {
  double before = INFINITY;
  for (const int rows : {1, 2, 4, 8}) {
    Random random(13);
    double sum = 0;
    const std::uint32_t scenes = scene_count(24);
    for (std::uint32_t scene = 0; scene < scenes; ++scene) {
      SeenBoard board = SeenBoard::grid(3, rows, 0.03, 0.045);
      board.look(some_lenses()[1], camera_above(0.7, 0.7, random), 0.2, random);
      const CameraLocation found = locate(board, some_lenses()[1]);
      CAPTURE(found.reason);
      REQUIRE(found.pose);
      sum += pose_distance(found.pose->T_world_cam, board.T_world_cam);
    }
    if (kAllScenes) CHECK(sum < 0.8 * before);
    before = sum;
  }
}

TEST_CASE("three misread or moved markers in ten are found") {
  Random random(14);
  for (std::uint32_t scene = 0; scene < scene_count(24); ++scene) {
    CAPTURE(scene);
    SeenBoard board = scene % 2 ? scattered(10, random) : SeenBoard::grid(5, 2, 0.04, 0.06);
    board.look(some_lenses()[1], camera_above(0.8, random.uniform(0.3, 0.7), random), 0.2, random);
    std::swap(board.pixels(1), board.pixels(4));  // read as each other
    for (Eigen::Vector2d& pixel : board.pixels(7)) pixel += Eigen::Vector2d(9, -7);  // moved
    const CameraLocation found = locate(board, some_lenses()[1]);
    CAPTURE(found.reason);
    REQUIRE(found.pose);
    CHECK(found.outliers == std::vector<std::size_t>{1, 4, 7});
    CHECK(found.inliers == std::vector<std::size_t>{0, 2, 3, 5, 6, 8, 9});
    CHECK(pose_distance(found.pose->T_world_cam, board.T_world_cam) < 0.05);
    CHECK(found.pose->rms_px < 0.5);
  }
}

TEST_CASE("of two observations of one marker the one that fits is taken") {
  Random random(15);
  SeenBoard board = SeenBoard::grid(4, 2, 0.04, 0.06);
  board.look(some_lenses()[0], camera_above(0.7, 0.6, random), 0.1, random);
  board.observations.insert(board.observations.begin(), board.observations[3]);
  for (Eigen::Vector2d& pixel : board.pixels(0)) pixel.x() -= 40;
  board.observations.push_back(board.observations[5]);  // found twice at the same place
  for (Eigen::Vector2d& pixel : board.pixels(9)) pixel.x() += 0.5;
  const CameraLocation found = locate(board);
  REQUIRE(found.pose);
  CHECK(found.outliers == std::vector<std::size_t>{0, 9});
  CHECK(pose_distance(found.pose->T_world_cam, board.T_world_cam) < 0.02);
}

TEST_CASE("a marker that is on the board twice is told apart by its position") {
  Random random(16);
  SeenBoard board = SeenBoard::grid(4, 2, 0.04, 0.06);
  for (const std::size_t twin : {5, 6}) board.features[twin].key = board.features[0].key;
  board.look(some_lenses()[0], camera_above(0.7, 0.6, random), 0.1, random);
  const CameraLocation found = locate(board);
  REQUIRE(found.pose);
  CHECK(found.inliers.size() == 8);
  CHECK(pose_distance(found.pose->T_world_cam, board.T_world_cam) < 0.02);
}

TEST_CASE("two groups of markers that contradict each other give no pose") {
  Random random(17);
  SeenBoard board = SeenBoard::grid(4, 2, 0.04, 0.06);
  board.look(some_lenses()[0], camera_above(0.7, 0.6, random), 0, random);
  for (const std::size_t i : {0, 3, 5, 6}) {
    const Pose moved = Pose::from_translation({0.1, 0.05, 0});
    const auto points = board.features[i].points();
    for (std::size_t c = 0; c < 4; ++c) {
      board.pixels(i)[c] =
          some_lenses()[0].project(board.T_world_cam.inverse() * (moved * points[c]));
    }
  }
  const CameraLocation found = locate(board);
  CHECK(!found.pose);
  CHECK(found.alternatives.size() == 2);
  check_parts(found.reason, {"4 markers of the board support one pose and 4 others"});
}

TEST_CASE("no pose without a reason that helps") {
  Random random(18);
  const Lens& lens = some_lenses()[0];
  SeenBoard board = SeenBoard::grid(3, 2, 0.05, 0.07);
  board.look(lens, camera_above(0.7, 0.6, random), 0.1, random);
  const auto reason = [&](const SeenBoard& changed, std::initializer_list<std::string_view> parts) {
    const CameraLocation found = locate(changed);
    CHECK(!found.pose);
    CHECK(found.inliers.empty());
    check_parts(found.reason, parts);
    return found;
  };
  SeenBoard none = board;
  none.observations.clear();
  reason(none, {"no marker of the board is seen: 0 observations", "6 features (e.g. aruco 4X4/0)"});
  SeenBoard others = board;
  for (Observation& seen : others.observations) seen.key.value = "4X4/40";
  CHECK(reason(others, {"6 observations (e.g. aruco 4X4/40), none"}).outliers.empty());
  SeenBoard faulty = board;
  faulty.features.resize(1);
  faulty.pixels(0)[2].x() = std::nan("");
  CHECK(reason(faulty, {"all 1 markers", "aruco 4X4/0: corner 2 is not finite"}).outliers.size() ==
        1);
  SeenBoard wrong = board;
  std::swap(wrong.pixels(0), wrong.pixels(5));
  wrong.observations = {wrong.observations[0], wrong.observations[1]};
  CHECK(reason(wrong, {"only 1 of the 2 markers", "within 3 px"}).outliers.size() == 2);
  SeenBoard empty;
  reason(empty, {"0 observations", "0 features"});

  // Single points on one line.
  SeenBoard line;
  const Eigen::Vector2d pixels[] = {{100, 240}, {200, 240}, {300, 240}, {400, 240}};
  for (int i = 0; i < 4; ++i) {
    const FeatureKey key{"keypoint", std::to_string(i)};
    line.features.push_back({key, FeaturePoints{{Eigen::Vector3d(0.1 * i, 0, 0)}}});
    line.observations.push_back({key, SeenPoints{{pixels[i]}, 0.1}});
  }
  reason(line, {"no pose follows from the 4 markers", "lie on one line"});
}

TEST_CASE("one faulty marker does no harm to the others") {
  Random random(19);
  SeenBoard board = SeenBoard::grid(3, 2, 0.05, 0.07);
  board.look(some_lenses()[0], camera_above(0.7, 0.6, random), 0.1, random);
  board.pixels(4)[1].y() = INFINITY;
  const CameraLocation found = locate(board);
  REQUIRE(found.pose);
  CHECK(found.outliers == std::vector<std::size_t>{4});
  CHECK(pose_distance(found.pose->T_world_cam, board.T_world_cam) < 0.02);
}

TEST_CASE("a board of single points, not on one plane, locates the camera too") {
  Random random(20);
  SeenBoard board;
  const Pose camera = camera_above(0.8, 0.5, random);
  for (int i = 0; i < 8; ++i) {
    const FeatureKey key{"keypoint", std::to_string(i)};
    const Eigen::Vector3d at = random.in_cube(0.15);
    board.features.push_back({key, FeaturePoints{{at}}});
    const Eigen::Vector2d pixel = some_lenses()[1].project(camera.inverse() * at);
    board.observations.push_back({key, SeenPoints{{pixel}, 0.1}});
  }
  const CameraLocation found = locate(board, some_lenses()[1]);
  CAPTURE(found.reason);
  REQUIRE(found.pose);
  CHECK(pose_distance(found.pose->T_world_cam, camera) < 1e-8);
}

}  // namespace vantage::test
