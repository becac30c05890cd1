#include <doctest/doctest.h>
#include <fmt/format.h>

#include "reconstruction/seen_board.hpp"
#include "support/expect_error.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

/// How often a camera was located, wrongly, and not at all as the pose was ambiguous.
struct FlipTally {
  std::size_t right = 0, wrong = 0, ambiguous = 0;

  void look(SeenBoard board, const Lens& lens, const Pose& camera, double sigma_px,
            Random& random) {
    board.look(lens, camera, sigma_px, random);
    const CameraLocation found = locate_camera(lens, board.observations, board.features);
    CHECK(found.pose.has_value() == found.reason.empty());
    if (found.pose) {
      const Eigen::Matrix3d turns = found.pose->covariance.bottomRightCorner<3, 3>();
      const double off = turn_between(found.pose->T_world_cam, camera);
      ++(off < 5 * std::sqrt(turns.trace()) ? right : wrong);
    } else {
      ++ambiguous;
      REQUIRE(found.alternatives.size() == 2);
      CHECK(found.alternatives[0].chi_square <= found.alternatives[1].chi_square);
      check_parts(found.reason, {"ambiguous", "chi-square", "move the camera closer"});
    }
  }
  std::string summary() const {
    return fmt::format("{} right, {} wrong, {} ambiguous", right, wrong, ambiguous);
  }
};

}  // namespace

TEST_CASE("a planar board far away is located rightly or ambiguous, and not confidently wrong") {
  Random random(21);
  FlipTally tally;
  const std::uint32_t cameras = scene_count(1000);
  for (std::uint32_t i = 0; i < cameras; ++i) {
    const SeenBoard board = SeenBoard::grid(2, 1 + int(random.below(2)), 0.05, 0.08);
    const Lens& lens = some_lenses()[random.below(std::uint32_t(some_lenses().size()))];
    tally.look(board, lens, camera_above(random.uniform(1, 3), random.uniform(0, 0.8), random), 0.3,
               random);
  }
  MESSAGE(tally.summary());
  CHECK(tally.wrong <= cameras / 1000);
  CHECK(tally.ambiguous >= enough(100));
  CHECK(tally.right >= enough(100));
}

TEST_CASE("two markers that are not in one plane, and a single one, are not guessed either") {
  Random random(22);
  FlipTally two, one;
  const std::uint32_t cameras = scene_count(500);
  for (std::uint32_t i = 0; i < cameras; ++i) {
    SeenBoard board;
    board.add_marker(3, 0.05, facing_up(0.05, random));
    const Lens& lens = some_lenses()[random.below(std::uint32_t(some_lenses().size()))];
    one.look(board, lens, camera_above(random.uniform(0.3, 1.5), random.uniform(0, 0.7), random),
             0.2, random);
    board.add_marker(9, 0.05, facing_up(0.05, random));
    two.look(board, lens, camera_above(random.uniform(0.5, 3), random.uniform(0, 0.7), random), 0.2,
             random);
  }
  MESSAGE("one: ", one.summary(), "; two: ", two.summary());
  CHECK(one.wrong <= 1);
  CHECK(two.wrong <= 1);
  CHECK(one.ambiguous >= enough(100));
  CHECK(two.right >= enough(100));
}

TEST_CASE("evidence is counted in the residuals' own variance where sigmas are too small") {
  Random random(23);
  FlipTally tally;
  const std::uint32_t cameras = scene_count(300);
  for (std::uint32_t i = 0; i < cameras; ++i) {
    SeenBoard board = SeenBoard::grid(3, 2, 0.04, 0.06);
    const Lens& lens = some_lenses()[0];
    const Pose camera = camera_above(2.5, random.uniform(0, 0.6), random);
    board.look(lens, camera, 0.3, random);
    for (Observation& seen : board.observations) std::get<SeenPoints>(seen.data).sigma_px = 0.05;
    const CameraLocation found = locate_camera(lens, board.observations, board.features);
    if (!found.pose) continue;
    const double turn = turn_between(found.pose->T_world_cam, camera);
    ++(turn < 5 * std::sqrt(found.pose->covariance.bottomRightCorner<3, 3>().trace())
           ? tally.right
           : tally.wrong);
  }
  MESSAGE(tally.summary());
  CHECK(tally.wrong <= 1);
}

}  // namespace vantage::test
