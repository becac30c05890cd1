#pragma once

#include <optional>
#include <span>
#include <vector>

#include "pose/pose_fit.hpp"

namespace vantage::reconstruction::detail {

/// An observation that may be this feature of the board. Its term is for the board's pose
/// T_cam_world: the body is the world, the reference the camera.
struct BoardPair {
  std::size_t observation = 0;
  std::size_t feature = 0;
  PointTerm term;
};

/// A pose with the pairs that agree with it.
struct BoardFit {
  std::vector<std::size_t> pairs;  ///< rising
  PoseFit fit;

  const Pose& T_cam_world() const { return fit.T_ref_body; }
  std::size_t points(std::span<const BoardPair> all) const;
};

/// Of all pairs, those with no point farther than `tolerance_px` from its pixel; every observation
/// and every feature at most once, the closest pairs first to choose. Indices, rising.
struct Agreement {
  std::vector<std::size_t> pairs;
  double score = 0;  ///< Σ over the pairs of 1 - (worst residual / tolerance)²
};
Agreement agreement(std::span<const BoardPair> pairs, const Pose& T_cam_world, double tolerance_px);

/// The least squares over some pairs; nothing if there is no such pose.
std::optional<PoseFit> fit_pairs(std::span<const BoardPair> all, std::span<const std::size_t> pairs,
                                 const Pose& T_cam_world, double loss_sigmas);

/// From a rough pose to the pairs that agree with it within `inlier_px`, and the least squares over
/// them: fits robustly and collects again, with less and less tolerance, until nothing changes.
/// Nothing if fewer than four points are left.
std::optional<BoardFit> settle(std::span<const BoardPair> pairs, const Pose& T_cam_world,
                               double inlier_px);

/// The fit again, where the residuals are larger than noise makes them in one of a thousand cases,
/// with what calibration, lens and print add to it (model_error.hpp): adds that to the terms'
/// sigmas.
BoardFit with_model_error(std::vector<BoardPair>& pairs, BoardFit board);

/// How far off a rough pose from a single marker may put the others, in units of `inlier_px`.
inline constexpr double kRough = 8;

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

/// The sum of squares where no marker is taken to be flatter than 1.5 % of its size: what a bent
/// sheet does to the pixels is no evidence for one of two tilts.
double chi_square_if_bent(std::span<const BoardPair> all, const BoardFit& board);

/// What a chi-square is to be divided by where the residuals are larger than their sigmas say: what
/// is left over is then the camera's calibration or the board's bend, and proves nothing.
double excess_of(double chi_square, std::size_t points);

/// Every pose T_cam_world that one pair alone suggests (both flips of a marker), and those from all
/// pairs at once, which may do for a board of single points. The ones that most pairs agree with,
/// roughly, come first.
std::vector<Pose> hypotheses(std::span<const BoardPair> pairs, double inlier_px);

/// Settles the most promising of them; the fit that most points agree with comes first, of equal
/// ones that with the least chi-square. Some may be the same. Ends early once every pair agrees.
std::vector<BoardFit> settled_fits(std::span<const BoardPair> pairs,
                                   std::span<const Pose> hypotheses, double inlier_px);

}  // namespace vantage::reconstruction::detail
