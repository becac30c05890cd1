#pragma once

#include <span>
#include <vector>

#include "locate/board_fit.hpp"

namespace vantage::detail {

/// Poses in which a board, seen from far away, has nearly the same image: its mirror image by the
/// plane across the line of sight, made proper by mirroring the board by its own principal planes.
/// Exact for a planar board in parallel projection; close for one that is long and thin.
std::vector<Pose> mirrored_poses(std::span<const BoardPair> all, const BoardFit& board);

/// Other poses in which the same pairs have a least sum of squares of their own, found from these
/// starts; the likeliest first. Those less than three standard deviations from the board's own pose
/// are no others: its covariance speaks for them.
std::vector<PoseFit> other_minima(std::span<const BoardPair> all, const BoardFit& board,
                                  std::span<const Pose> starts);

/// Degrees of freedom that are left for the residuals of so many points.
double freedom_of(std::size_t points);

/// What a chi-square is to be divided by where the residuals are larger than their sigmas say: what
/// is left over is then the camera's calibration or the board's bend, and proves nothing.
double excess_of(double chi_square, std::size_t points);

}  // namespace vantage::detail
