#pragma once

#include <span>
#include <vector>

#include "locate/board_fit.hpp"

namespace vantage::detail {

/// Every pose T_cam_world that one pair alone suggests (both flips of a marker), and those from all
/// pairs at once, which may do for a board of single points. The ones that most pairs agree with,
/// roughly, come first.
std::vector<Pose> hypotheses(std::span<const BoardPair> pairs, double inlier_px);

/// Settles the most promising of them; the fit that most points agree with comes first, of equal
/// ones that with the least chi-square. Some may be the same. Ends early once every pair agrees.
std::vector<BoardFit> settled_fits(std::span<const BoardPair> pairs,
                                   std::span<const Pose> hypotheses, double inlier_px);

}  // namespace vantage::detail
