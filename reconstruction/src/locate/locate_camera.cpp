#include "vantage/reconstruction/locate_camera.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "locate/board_pose.hpp"
#include "locate/explain_contradiction.hpp"
#include "locate/match_board.hpp"
#include "locate/residual_cause.hpp"
#include "pose/pose_manifold.hpp"
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
      "expected two at least, and twice as many as contradict them; check the board's sizes and "
      "positions in the workcell and the camera's calibration",
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
      "the pose is ambiguous: two poses that differ by {:.3g} m and {:.3g}° explain the {} {} of "
      "the board nearly equally well, chi-square {:.4g} and {:.4g}, a difference of {:.3g} in "
      "units of the residuals' own variance where prints are not perfectly flat, expected {:g}; "
      "move the camera closer or to the side, or add markers outside that plane",
      (best.T_world_cam.translation() - other.T_world_cam.translation()).norm(),
      turn * 180 / EIGEN_PI, markers, markers == 1 ? "marker" : "markers", best.chi_square,
      other.chi_square, evidence, expected);
}

/// Another set of as many markers that supports another pose.
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
        "the pose is ambiguous: {} markers of the board support one pose and {} others another "
        "one; check which of them were moved, or are on the board twice",
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
  const double chi_square = reconstruction::detail::chi_square_if_bent(all, best);
  const double excess = reconstruction::detail::excess_of(chi_square, best.points(all));
  const double evidence =
      (reconstruction::detail::chi_square_if_bent(all, other) - chi_square) / excess;
  if (evidence >= min_evidence) {
    location.pose = located(all, best);
    return;
  }
  location.alternatives = {located(all, best), located(all, other)};
  location.reason = flip_reason(location.alternatives[0], location.alternatives[1],
                                best.pairs.size(), evidence, min_evidence);
}

/// The board's markers that are seen and that a pose does not explain, each once. A marker that is
/// seen twice, of which one fits, contradicts nothing.
std::vector<std::string> contradicting(const SeenBoard& seen, const BoardFit& best,
                                       std::span<const Observation> observations) {
  std::set<FeatureKey> explained;
  for (const std::size_t i : best.pairs) {
    explained.insert(observations[seen.pairs[i].observation].key);
  }
  std::set<FeatureKey> others;
  for (const BoardPair& pair : seen.pairs) {
    const FeatureKey& key = observations[pair.observation].key;
    if (!explained.contains(key)) others.insert(key);
  }
  std::vector<std::string> names;
  for (const FeatureKey& key : others) names.push_back(key.value);
  return names;
}

std::size_t markers_in(const SeenBoard& seen, std::span<const Observation> observations) {
  std::set<FeatureKey> keys;
  for (const BoardPair& pair : seen.pairs) keys.insert(observations[pair.observation].key);
  return keys.size();
}

/// The covariance with room for an error that is known by its cause.
void widen(LocatedPose& pose, const Pose& T_world_cam) {
  Eigen::Matrix<double, 6, 1> error;
  error.head<3>() = T_world_cam.translation() - pose.T_world_cam.translation();
  error.tail<3>() = reconstruction::detail::log_of(T_world_cam.quaternion() *
                                                   pose.T_world_cam.quaternion().conjugate());
  pose.covariance += error * error.transpose();
}

/// What contradicts a pose that was found.
void doubt(const Lens& lens, const SeenBoard& seen, const BoardFit& best,
           const std::optional<reconstruction::detail::Explanation>& explanation,
           const std::vector<std::string>& against, CameraLocation& location) {
  if (!against.empty()) {
    location.warning = fmt::format(
        "{} of the {} markers of the board that are seen contradict the pose ({}): {}",
        against.size(), location.markers_seen, fmt::join(against, ", "),
        explanation
            ? fmt::format("all but {} agree if {}", location.markers_seen - explanation->markers,
                          explanation->cause)
            : std::string("they were moved or misread, or the workcell has them elsewhere"));
    if (explanation) {
      if (explanation->markers == location.markers_seen) {
        location.warning = fmt::format(
            "{} of the {} markers of the board that are seen contradict the pose ({}): all agree "
            "if {}",
            against.size(), location.markers_seen, fmt::join(against, ", "), explanation->cause);
      }
      widen(*location.pose, explanation->T_cam_world.inverse());
      return;
    }
  }
  const auto residuals = reconstruction::detail::residual_cause(lens, seen.pairs, best);
  if (!residuals) return;
  // Real lenses and prints are never quite as they should be, and noise is stated too small at
  // times.
  constexpr double kNotable = 3, kNotable_px = 0.3;
  // The corners of one marker err together: they count as one.
  constexpr double kCornersOfMarker = 4;
  if (residuals->cause.empty()) location.pose->covariance *= kCornersOfMarker;
  if (!residuals->cause.empty()) widen(*location.pose, residuals->T_cam_world.inverse());
  if (residuals->noise_ratio < kNotable) return;
  if (residuals->cause.empty() && location.pose->rms_px < kNotable_px) return;
  const std::string text = fmt::format(
      "the residuals are {:.1f} times the corners' noise: {}", residuals->noise_ratio,
      residuals->cause.empty() ? "check the calibration, and the board's sizes and flatness"
                               : "most of that is gone if " + residuals->cause);
  location.warning += (location.warning.empty() ? "" : "; ") + text;
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
  location.markers_seen = markers_in(seen, observations);
  const std::vector<std::string> against =
      best ? contradicting(seen, *best, observations) : std::vector<std::string>();
  std::optional<reconstruction::detail::Explanation> explanation;
  if (!best || !against.empty()) {
    explanation = reconstruction::detail::explain_contradiction(
        lens, seen.pairs, board, best ? best->pairs.size() : 1, location.markers_seen,
        options.inlier_px);
  }
  const std::string hint =
      explanation ? fmt::format("; {} agree if {}", explanation->markers, explanation->cause)
                  : std::string();
  // A misread marker fits a pose of its own as well as a correct one.
  const bool mistaken = explanation && explanation->exact && against.size() > 1 &&
                        explanation->markers == location.markers_seen;
  const bool majority = best && best->pairs.size() >= 2 * against.size() && !mistaken;
  const bool two_groups = best && contradiction(seen.pairs, fits) != nullptr;
  if (!best || (!majority && !two_groups) ||
      (best->pairs.size() < 2 && seen.observations.size() > 1)) {
    location.reason = disagreement(seen, best, options.inlier_px) + hint;
    return location;
  }
  for (const std::size_t i : best->pairs) {
    location.inliers.push_back(seen.pairs[i].observation);
    std::erase(location.outliers, seen.pairs[i].observation);
  }
  decide(seen.pairs, fits, hypotheses, options.min_evidence, location);
  if (!location.pose) location.reason += hint;
  if (location.pose) doubt(lens, seen, *best, explanation, against, location);
  return location;
}

}  // namespace vantage
