#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "locate/board_pose.hpp"

namespace vantage::reconstruction::detail {

/// Another way in which a calibration, a picture or a board may have been meant.
struct BoardReading {
  std::string cause;  ///< a clause for the user: "the focal length is 0.83 times that of cam_K"
  Lens lens;
  std::vector<std::vector<Eigen::Vector3d>> points_m;  ///< of each of the board's features
};

/// Readings that differ by a factor: of a length, or 1 where there is nothing to vary.
struct ReadingFamily {
  std::function<std::optional<BoardReading>(double factor)> at;
  std::vector<double> factors;  ///< rising; more than one: the best one may lie beside them
};

/// Between neighbouring factors of a family that is to be refined.
inline constexpr double kFactorStep = 1.1;

/// What people get wrong: the focal length, the resolution of the intrinsics, the size of the
/// markers, the direction of an axis, the turn of a picture or of the markers, the parity of a
/// checkerboard. The causes say what is the case, relative to what was given.
std::vector<ReadingFamily> reading_families(const Lens& lens, std::span<const ObjectFeature> board);

/// The pairs as a reading has them. Their terms point to its lens.
std::vector<BoardPair> pairs_of(const BoardReading& reading, std::span<const BoardPair> pairs);

/// The points that a checkerboard of markers has if they are on the squares of the other colour;
/// nothing if the board is no such checkerboard.
std::optional<std::vector<std::vector<Eigen::Vector3d>>> other_parity(
    std::span<const ObjectFeature> board);

}  // namespace vantage::reconstruction::detail
