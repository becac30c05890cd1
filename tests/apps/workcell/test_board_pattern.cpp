#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "apps/cell_files.hpp"
#include "support/expect_error.hpp"
#include "workcell/workcell.hpp"

namespace vantage::test {
namespace {

Workcell cell_with(const std::string& text) {
  TemporaryFolder folder;
  return load_workcell(folder.write("cell.yaml", kAreaLine + text));
}

void expect_pattern_refused(const std::string& text, std::string_view where,
                            std::initializer_list<std::string_view> parts) {
  CAPTURE(text);
  expect_refused([&] { cell_with(text); }, where, parts);
}

std::map<int, Eigen::Vector2d> centres(const Board& board) {
  std::map<int, Eigen::Vector2d> all;
  for (const Marker& m : board.markers) all[m.id] = m.T_object_marker.translation().head<2>();
  return all;
}

Eigen::Matrix4d pose_in(const std::string& pose) {
  const Workcell cell =
      cell_with("known_objects: [{name: b, box: {min_m: [0, 0, 0], max_m: [1, 1, 1]}, pose: {" +
                pose + "}}]");
  const Pose& T = cell.known_objects.at(0).T_world_object;
  Eigen::Matrix4d m = Eigen::Matrix4d::Identity();
  m.topLeftCorner<3, 3>() = T.rotation(), m.topRightCorner<3, 1>() = T.translation();
  return m;
}

}  // namespace

TEST_CASE("a charuco board has its markers where a real print of OpenCV's has them") {
  const Board board = *cell_with(
                           "board: {charuco: {columns: 5, rows: 7, square_m: 0.04, marker_m: "
                           "0.02, dictionary: DICT_6X6_250}}\n")
                           .board;
  CHECK(board.size_m.isApprox(Eigen::Vector2d(0.2, 0.28)));
  CHECK(board.markers.size() == 17);
  const auto made = centres(board);
  const auto measured = centres(*load_workcell(shipped_workcell("charuco")).board);
  CHECK(measured.size() == 9);
  for (const auto& [id, centre] : measured) CHECK((made.at(id) - centre).norm() < 1e-12);
  CHECK(board.markers[0].dictionary == "6X6_250");
  CHECK(board.markers[0].size_m == 0.02);
}

TEST_CASE("legacy charuco boards of an even number of rows begin with a white square") {
  const std::string even = "columns: 3, rows: 4, square_m: 0.1, marker_m: 0.05, dictionary: 4X4_50";
  const auto now = centres(*cell_with("board: {charuco: {" + even + "}}\n").board);
  const auto legacy = centres(*cell_with("board: {charuco: {" + even + ", legacy: true}}\n").board);
  CHECK(now.at(0).isApprox(Eigen::Vector2d(0, 0.15)));
  CHECK(legacy.at(0).isApprox(Eigen::Vector2d(-0.1, 0.15)));
  CHECK(now.size() == 6);
  CHECK(legacy.size() == 6);
  const std::string odd = "columns: 3, rows: 5, square_m: 0.1, marker_m: 0.05, dictionary: 4X4_50";
  CHECK(centres(*cell_with("board: {charuco: {" + odd + "}}\n").board) ==
        centres(*cell_with("board: {charuco: {" + odd + ", legacy: true}}\n").board));
}

TEST_CASE("a grid has rows of markers, counted from the upper left") {
  const Board board = *cell_with(
                           "board: {grid: {columns: 3, rows: 2, marker_m: 0.04, gap_m: 0.01, "
                           "dictionary: tag36h11, first_id: 7}, size_m: [0.3, 0.2]}\n")
                           .board;
  CHECK(board.size_m == Eigen::Vector2d(0.3, 0.2));
  const auto made = centres(board);
  CHECK(made.size() == 6);
  CHECK(made.at(7).isApprox(Eigen::Vector2d(-0.05, 0.025)));
  CHECK(made.at(9).isApprox(Eigen::Vector2d(0.05, 0.025)));
  CHECK(made.at(12).isApprox(Eigen::Vector2d(0.05, -0.025)));
  CHECK(board.markers[0].dictionary == "APRILTAG_36h11");
}

TEST_CASE("boards that cannot be are refused with their key") {
  const std::string charuco =
      "charuco: {columns: 5, rows: 7, square_m: 0.04, marker_m: 0.02, dictionary: 4X4_50}";
  expect_pattern_refused("board: {size_m: [1, 1], dictionary: 4X4_50}\n", "board",
                         {"none of the keys markers, charuco and grid"});
  expect_pattern_refused("board: {" + charuco + ", markers: []}\n", "board", {"found 2"});
  expect_pattern_refused("board: {" + charuco + ", dictionary: 4X4_50}\n", "board.dictionary",
                         {"does not belong"});
  expect_pattern_refused("board: {" + charuco + ", size_m: [0.1, 0.28]}\n", "board.size_m",
                         {"0.1 x 0.28", "0.2 x 0.28"});
  expect_pattern_refused("board: {dictionary: 4X4_50, markers: []}\n", "board", {"\"size_m\""});
  expect_pattern_refused(
      "board: {charuco: {columns: 5, rows: 7, square_m: 0.02, marker_m: 0.02, "
      "dictionary: 4X4_50}}\n",
      "board.charuco.marker_m", {"less than square_m"});
  expect_pattern_refused(
      "board: {charuco: {columns: 50, rows: 7, square_m: 0.03, marker_m: 0.02, "
      "dictionary: 4X4_50}}\n",
      "board.charuco.dictionary", {"50 markers"});
  expect_pattern_refused(
      "board: {grid: {columns: 5, rows: 7, gap_m: 0.03, marker_m: 0.02, "
      "dictionary: 9X9}}\n",
      "board.grid.dictionary", {"no marker dictionary '9X9'", "4X4_50"});
}

TEST_CASE("markers beside their board or wider than it are refused") {
  const std::string board = "board: {size_m: [0.5, 0.3], dictionary: 4X4_50, markers: [";
  expect_pattern_refused(board + "{id: 1, size_m: 0.04, at_m: [0.2, 15]}]}\n",
                         "board.markers[0].at_m", {"(0.2, 15)", "0.5 x 0.3"});
  expect_pattern_refused(board + "{id: 1, size_m: 0.4, at_m: [0, 0]}]}\n",
                         "board.markers[0].size_m", {"0.4 m wide"});
}

TEST_CASE("poses as matrix, roll pitch yaw, and by what they look at") {
  const Eigen::Matrix4d quaternion = pose_in(
      "translation_m: [1, 2, 3], rotation: {w: 0.7071067811865476, x: 0, y: 0, z: "
      "0.7071067811865476}");
  CHECK(pose_in("matrix: [[0, -1, 0, 1], [1, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]")
            .isApprox(quaternion, 1e-12));
  CHECK(pose_in("translation_m: [1, 2, 3], rpy_rad: [0, 0, 1.5707963267948966]")
            .isApprox(quaternion, 1e-12));
  // URDF: yaw · pitch · roll.
  const Eigen::Matrix3d turned = pose_in("rpy_rad: [0.1, 0.2, 0.3]").topLeftCorner<3, 3>();
  CHECK(turned(2, 0) == doctest::Approx(-std::sin(0.2)));
  CHECK(turned(1, 0) / turned(0, 0) == doctest::Approx(std::tan(0.3)));
  CHECK(turned(2, 1) / turned(2, 2) == doctest::Approx(std::tan(0.1)));
  const Eigen::Matrix4d looking = pose_in("translation_m: [0, -1, 0.5], look_at_m: [0, 0, 0.5]");
  CHECK(looking.col(2).head<3>().isApprox(Eigen::Vector3d::UnitY()));
  CHECK(looking.col(1).head<3>().isApprox(-Eigen::Vector3d::UnitZ()));

  const auto refused = [](const std::string& pose, std::string_view where,
                          std::initializer_list<std::string_view> parts) {
    CAPTURE(pose);
    expect_refused([&] { pose_in(pose); }, where, parts);
  };
  refused("rpy_rad: [0, 0, 0], matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
          "pose.matrix", {"twice", "rpy_rad"});
  refused("matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [1, 0, 0, 1]]", "pose.matrix[3]",
          {"last row"});
  refused("matrix: [[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]", "pose.matrix",
          {"no rotation"});
  refused("look_at_m: [0, 0, 0]", "pose.look_at_m", {"where the pose itself is"});
}

}  // namespace vantage::test
