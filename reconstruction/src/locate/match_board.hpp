#pragma once

#include <span>
#include <string>
#include <vector>

#include "locate/board_pose.hpp"
#include "vantage/reconstruction/observation.hpp"

namespace vantage::reconstruction::detail {

/// What of the board is seen.
struct SeenBoard {
  std::vector<BoardPair> pairs;
  std::vector<std::size_t> observations;  ///< with a key of the board's, faulty ones too
  std::size_t sound = 0;                  ///< how many of them have pairs
  std::string fault;                      ///< of the first faulty one
};

/// Pairs every observation of points with every feature of the board that has its key.
SeenBoard match_board(const Lens& lens, std::span<const Observation> observations,
                      std::span<const ObjectFeature> board);

/// Why nothing can be known of the camera before anything is computed; empty if something can.
std::string lack_of(const SeenBoard& seen, std::span<const Observation> observations,
                    std::span<const ObjectFeature> board);

}  // namespace vantage::reconstruction::detail
