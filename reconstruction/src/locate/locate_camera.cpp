#include "vantage/reconstruction/locate_camera.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "locate/board_pose.hpp"
#include "locate/match_board.hpp"
#include "pose/solve_pnp.hpp"

namespace vantage {
namespace {

using reconstruction::detail::BoardFit;
using reconstruction::detail::BoardPair;
using reconstruction::detail::SeenBoard;

std::string disagreement(const SeenBoard& seen, const BoardFit* best, double inlier_px) {
  if (!best) {
    return fmt::format(
        "no pose follows from the {} markers of the board that are seen: their points are "
        "fewer than four, lie on one line, or are nowhere before the camera",
        seen.sound);
  }
  return fmt::format(
      "only {} of the {} markers of the board that are seen agree on a pose within {:g} px, "
      "expected two at least; check the board's sizes and positions in the workcell and "
      "the camera's calibration",
      best->pairs.size(), seen.sound, inlier_px);
}

/// The camera's pose from the board's in its frame, with what the residuals say about it. Its
/// chi-square is that of the corners' noise alone.
LocatedPose located(std::span<const BoardPair> all, const BoardFit& board) {
  std::vector<BoardPair> pairs(all.begin(), all.end());
  const BoardFit weighed = reconstruction::detail::with_model_error(pairs, board);
  Matrix6d information = Matrix6d::Zero();
  for (const std::size_t i : weighed.pairs) {
    reconstruction::detail::PointTerm term = pairs[i].term;
    term.T_cam_ref = weighed.T_cam_world();  // and the body, which is the world, where it is
    const auto j = reconstruction::detail::camera_jacobian(term, {});
    information += j.transpose() * j / (term.sigma_px * term.sigma_px);
  }
  return {weighed.T_cam_world().inverse(), reconstruction::detail::covariance_of(information),
          weighed.fit.rms_px, board.fit.chi_square};
}

double turn_between(const Pose& a, const Pose& b) {
  return Eigen::AngleAxisd(Eigen::Matrix3d(a.rotation().transpose() * b.rotation())).angle();
}

/// Poses from which another minimum over the same pairs may be reached.
std::vector<Pose> rival_starts(std::span<const BoardPair> all, const BoardFit& board,
                               std::span<const Pose> hypotheses) {
  constexpr std::size_t kMaxHypotheses = 6;
  std::vector<Pose> starts = reconstruction::detail::mirrored_poses(all, board);
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
  for (const std::size_t i : board.pairs) {
    const reconstruction::detail::PointTerm& term = all[i].term;
    points.insert(points.end(), term.points_m.begin(), term.points_m.end());
    pixels.insert(pixels.end(), term.pixels.begin(), term.pixels.end());
  }
  // From a start close to another one the same minimum is reached.
  const auto add = [&](const Pose& start) {
    constexpr double kClose = 0.05;  // radians
    const auto close = [&](const Pose& known) { return turn_between(known, start) < kClose; };
    if (!close(board.T_cam_world()) && std::ranges::none_of(starts, close)) starts.push_back(start);
  };
  for (const auto& guess :
       reconstruction::detail::solve_pnp(*all.front().term.lens, points, pixels)) {
    add(guess.T_cam_body);
  }
  for (const Pose& pose : hypotheses.first(std::min(hypotheses.size(), kMaxHypotheses))) add(pose);
  return starts;
}

std::string flip_reason(const LocatedPose& best, const LocatedPose& other, std::size_t markers,
                        double evidence, double expected) {
  const double turn = turn_between(best.T_world_cam, other.T_world_cam);
  return fmt::format(
      "the pose is ambiguous: two poses that differ by {:.3g} m and {:.3g}° explain the {} "
      "{} of the board nearly equally well, chi-square {:.4g} and {:.4g}, a difference of "
      "{:.3g} in units of the residuals' own variance, expected {:g}; move the camera closer "
      "or aside, or add markers that do not lie in the same plane",
      (best.T_world_cam.translation() - other.T_world_cam.translation()).norm(),
      turn * 180 / EIGEN_PI, markers, markers == 1 ? "marker" : "markers", best.chi_square,
      other.chi_square, evidence, expected);
}

/// Another set of as many markers that speaks for another pose.
const BoardFit* contradiction(std::span<const BoardPair> all, std::span<const BoardFit> fits) {
  const BoardFit& best = fits.front();
  for (const BoardFit& other : fits.subspan(1)) {
    if (other.points(all) == best.points(all) && other.pairs != best.pairs) return &other;
  }
  return nullptr;
}

/// Fills in the pose, or the reason why it remains open.
void decide(std::span<const BoardPair> all, std::span<const BoardFit> fits,
            std::span<const Pose> hypotheses, double min_evidence, CameraLocation& location) {
  BoardFit best = fits.front();
  if (const BoardFit* other = contradiction(all, fits)) {
    location.alternatives = {located(all, best), located(all, *other)};
    location.reason = fmt::format(
        "the pose is ambiguous: {} markers of the board speak for one pose and {} others for "
        "another one; check which of them were moved, or are on the board twice",
        best.pairs.size(), other->pairs.size());
    return;
  }
  const auto rivals =
      reconstruction::detail::other_minima(all, best, rival_starts(all, best, hypotheses));
  if (rivals.empty()) {
    location.pose = located(all, best);
    return;
  }
  BoardFit other = best;
  other.fit = rivals.front();
  if (other.fit.chi_square < best.fit.chi_square) std::swap(best, other);
  const double excess = reconstruction::detail::excess_of(best.fit.chi_square, best.points(all));
  const double evidence = (other.fit.chi_square - best.fit.chi_square) / excess;
  if (evidence >= min_evidence) {
    location.pose = located(all, best);
    return;
  }
  location.alternatives = {located(all, best), located(all, other)};
  location.reason = flip_reason(location.alternatives[0], location.alternatives[1],
                                best.pairs.size(), evidence, min_evidence);
}

}  // namespace

CameraLocation locate_camera(const Lens& lens, std::span<const Observation> observations,
                             std::span<const ObjectFeature> board, const LocateOptions& options) {
  CameraLocation location;
  const SeenBoard seen = reconstruction::detail::match_board(lens, observations, board);
  location.outliers = seen.observations;
  location.reason = reconstruction::detail::lack_of(seen, observations, board);
  if (!location.reason.empty()) return location;
  const std::vector<Pose> hypotheses =
      reconstruction::detail::hypotheses(seen.pairs, options.inlier_px);
  const auto fits = reconstruction::detail::settled_fits(seen.pairs, hypotheses, options.inlier_px);
  const BoardFit* best = fits.empty() ? nullptr : &fits.front();
  // A marker that is read wrongly fits to a pose of its own as well as a right one.
  if (!best || (best->pairs.size() < 2 && seen.observations.size() > 1)) {
    location.reason = disagreement(seen, best, options.inlier_px);
    return location;
  }
  for (const std::size_t i : best->pairs) {
    location.inliers.push_back(seen.pairs[i].observation);
    std::erase(location.outliers, seen.pairs[i].observation);
  }
  decide(seen.pairs, fits, hypotheses, options.min_evidence, location);
  return location;
}

}  // namespace vantage
