#pragma once

#include <optional>
#include <span>
#include <string>

#include "locate/board_pose.hpp"
#include "vantage/reconstruction/locate_camera.hpp"

namespace vantage::reconstruction::detail {

/// What explains that markers of the board contradict each other.
struct Explanation {
  std::string cause;        ///< a clause
  Pose T_cam_world;         ///< by it
  std::size_t markers = 0;  ///< that agree with it
  double chi_square = 0;
  bool exact = false;  ///< a plain mistake, not a length that was fitted
};

/// Tries the usual mistakes one after the other, and returns the one by which most markers agree:
/// more than `agreeing`, and two thirds of the `seen` ones at least. Nothing if there is none.
std::optional<Explanation> explain_contradiction(const Lens& lens, std::span<const BoardPair> pairs,
                                                 std::span<const ObjectFeature> board,
                                                 std::size_t agreeing, std::size_t seen,
                                                 double inlier_px);

}  // namespace vantage::reconstruction::detail
