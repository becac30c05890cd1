#pragma once

#include <optional>
#include <span>
#include <string>

#include "locate/board_pose.hpp"

namespace vantage::reconstruction::detail {

/// What the residuals of a located camera say beside its pose.
struct ResidualCause {
  double noise_ratio = 1;  ///< root of chi-square over its degrees of freedom: 1 is noise alone
  std::string cause;       ///< a clause; empty where no single cause explains most of it
  Pose T_cam_world;        ///< with that cause taken into account
};

/// Looks for one cause of residuals that are much larger than the corners' noise: the focal length,
/// radial distortion, a board that is bent, markers of another size. Nothing if noise and the usual
/// small errors of calibration and print explain them.
std::optional<ResidualCause> residual_cause(const Lens& lens, std::span<const BoardPair> pairs,
                                            const BoardFit& board);

}  // namespace vantage::reconstruction::detail
