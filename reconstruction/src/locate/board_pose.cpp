#include "locate/board_pose.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "pose/excess_variance.hpp"
#include "pose/pose_manifold.hpp"
#include "pose/principal_axes.hpp"
#include "pose/solve_pnp.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr int kMaxSelections = 20;
constexpr double kBoardLossSigmas = 3;

double worst_residual(const PointTerm& term, const Pose& T_cam_world) {
  const std::vector<double> residuals = residuals_px(term, T_cam_world);
  return *std::ranges::max_element(residuals);
}

}  // namespace

std::size_t BoardFit::points(std::span<const BoardPair> all) const {
  std::size_t count = 0;
  for (const std::size_t i : pairs) count += all[i].term.points_m.size();
  return count;
}

Agreement agreement(std::span<const BoardPair> pairs, const Pose& T_cam_world,
                    double tolerance_px) {
  struct Close {
    double worst;
    std::size_t pair;
    auto operator<=>(const Close&) const = default;
  };
  std::vector<Close> close;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double worst = worst_residual(pairs[i].term, T_cam_world);
    if (worst <= tolerance_px) close.push_back({worst, i});
  }
  std::ranges::sort(close);
  std::set<std::size_t> observations, features;
  Agreement result;
  for (const auto& [worst, i] : close) {
    if (observations.contains(pairs[i].observation) || features.contains(pairs[i].feature)) {
      continue;
    }
    observations.insert(pairs[i].observation);
    features.insert(pairs[i].feature);
    result.pairs.push_back(i);
    result.score += 1 - worst * worst / (tolerance_px * tolerance_px);
  }
  std::ranges::sort(result.pairs);
  return result;
}

std::optional<PoseFit> fit_pairs(std::span<const BoardPair> all, std::span<const std::size_t> pairs,
                                 const Pose& T_cam_world, double loss_sigmas) {
  std::vector<PointTerm> terms;
  for (const std::size_t i : pairs) terms.push_back(all[i].term);
  return fit_pose(terms, {}, T_cam_world, loss_sigmas);
}

std::optional<BoardFit> settle(std::span<const BoardPair> pairs, const Pose& T_cam_world,
                               double inlier_px) {
  BoardFit board{agreement(pairs, T_cam_world, kRough * inlier_px).pairs, {}};
  board.fit.T_ref_body = T_cam_world;
  double tolerance_px = kRough * inlier_px;
  for (int round = 0; round < kMaxSelections; ++round) {
    if (board.points(pairs) < 4) return {};
    const auto fit = fit_pairs(pairs, board.pairs, board.T_cam_world(), kBoardLossSigmas);
    if (!fit) return {};
    board.fit = *fit;
    std::vector<std::size_t> inliers = agreement(pairs, board.T_cam_world(), inlier_px).pairs;
    if (inliers == board.pairs) break;
    tolerance_px = std::max(tolerance_px / 2, inlier_px);
    board.pairs = tolerance_px > inlier_px
                      ? agreement(pairs, board.T_cam_world(), tolerance_px).pairs
                      : std::move(inliers);
  }
  if (board.points(pairs) < 4) return {};
  const auto fit = fit_pairs(pairs, board.pairs, board.T_cam_world(), 0);
  if (!fit) return {};
  board.fit = *fit;
  return board;
}

BoardFit with_model_error(std::vector<BoardPair>& pairs, BoardFit board) {
  constexpr int kRounds = 3;  // weights follow from residuals, and residuals from weights
  const double freedom = std::max(2 * double(board.points(pairs)) - 6, 1.0);
  if (board.fit.chi_square <= freedom * unlikely_ratio(freedom)) return board;
  const std::vector<BoardPair> original = pairs;
  for (int round = 0; round < kRounds; ++round) {
    std::vector<PointResidual> residuals;
    for (const std::size_t i : board.pairs) {
      for (const double px : residuals_px(original[i].term, board.T_cam_world())) {
        residuals.push_back({px * px, original[i].term.sigma_px});
      }
    }
    const double model_px = model_error_px(residuals, freedom);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      pairs[i].term.sigma_px = std::hypot(original[i].term.sigma_px, model_px);
    }
    const auto fit = fit_pairs(pairs, board.pairs, board.T_cam_world(), 0);
    if (!fit) break;
    board.fit = *fit;
  }
  return board;
}

namespace {

Eigen::Matrix3d mirror(const Eigen::Vector3d& normal) {
  return Eigen::Matrix3d::Identity() - 2 * normal * normal.transpose();
}

/// Whether a pose is farther from the board's than its residuals leave open.
bool is_apart(const Pose& T_cam_world, const PoseFit& board) {
  constexpr double kSigmas = 3;
  Eigen::Matrix<double, 6, 1> step;
  step.head<3>() = T_cam_world.translation() - board.T_ref_body.translation();
  step.tail<3>() = log_of(T_cam_world.quaternion() * board.T_ref_body.quaternion().conjugate());
  return step.dot(board.information * step) > kSigmas * kSigmas;
}

}  // namespace

std::vector<Pose> mirrored_poses(std::span<const BoardPair> all, const BoardFit& board) {
  std::vector<Eigen::Vector3d> points;
  for (const std::size_t i : board.pairs) {
    const auto& of_pair = all[i].term.points_m;
    points.insert(points.end(), of_pair.begin(), of_pair.end());
  }
  const auto [centre, axes, extents] = principal_axes(points);
  const Eigen::Vector3d centre_cam = board.T_cam_world() * centre;
  const Eigen::Matrix3d across_sight = mirror(centre_cam.normalized());
  std::vector<Pose> poses;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Matrix3d rotation =
        across_sight * board.T_cam_world().rotation() * mirror(axes.col(axis));
    poses.push_back(Pose::from_rotation(rotation, centre_cam - rotation * centre));
  }
  return poses;
}

std::vector<PoseFit> other_minima(std::span<const BoardPair> all, const BoardFit& board,
                                  std::span<const Pose> starts) {
  std::vector<PoseFit> others;
  for (const Pose& start : starts) {
    const auto fit = fit_pairs(all, board.pairs, start, 0);
    if (fit && is_apart(fit->T_ref_body, board.fit)) others.push_back(*fit);
  }
  std::ranges::stable_sort(others, {}, &PoseFit::chi_square);
  return others;
}

double chi_square_if_bent(std::span<const BoardPair> all, const BoardFit& board) {
  constexpr double kFlatness = 0.015;
  double sum = 0;
  for (const std::size_t i : board.pairs) {
    const PointTerm& term = all[i].term;
    const auto [centre, axes, extents] = principal_axes(term.points_m);
    const Eigen::Vector3d bend = 2 * kFlatness * extents[0] * axes.col(2);  // extents: half sides
    const std::vector<double> residuals = residuals_px(term, board.T_cam_world());
    for (std::size_t p = 0; p < residuals.size(); ++p) {
      const Eigen::Vector3d flat = board.T_cam_world() * term.points_m[p];
      const Eigen::Vector3d bent = board.T_cam_world() * (term.points_m[p] + bend);
      const double bend_px = (term.lens->project(bent) - term.lens->project(flat)).norm();
      sum += residuals[p] * residuals[p] / (term.sigma_px * term.sigma_px + bend_px * bend_px);
    }
  }
  return sum;
}

double freedom_of(std::size_t points) {
  return std::max(2 * double(points) - 6, 1.0);
}

double excess_of(double chi_square, std::size_t points) {
  return std::max(chi_square / freedom_of(points), 1.0);
}

namespace {

constexpr std::size_t kMaxSettled = 8;

std::vector<PoseGuess> guesses_from_all(std::span<const BoardPair> pairs) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
  for (const BoardPair& pair : pairs) {
    points.insert(points.end(), pair.term.points_m.begin(), pair.term.points_m.end());
    pixels.insert(pixels.end(), pair.term.pixels.begin(), pair.term.pixels.end());
  }
  if (pairs.empty()) return {};
  return solve_pnp(*pairs.front().term.lens, points, pixels);
}

}  // namespace

std::vector<Pose> hypotheses(std::span<const BoardPair> pairs, double inlier_px) {
  struct Scored {
    Pose pose;
    double score;
  };
  std::vector<Scored> scored;
  const auto add = [&](const std::vector<PoseGuess>& guesses) {
    for (const PoseGuess& guess : guesses) {
      const double score = agreement(pairs, guess.T_cam_body, kRough * inlier_px).score;
      scored.push_back({guess.T_cam_body, score});
    }
  };
  for (const BoardPair& pair : pairs) {
    add(solve_pnp(*pair.term.lens, pair.term.points_m, pair.term.pixels));
  }
  if (pairs.size() > 1) add(guesses_from_all(pairs));
  std::ranges::stable_sort(scored, std::ranges::greater{}, &Scored::score);
  std::vector<Pose> result;
  for (const Scored& s : scored) result.push_back(s.pose);
  return result;
}

std::vector<BoardFit> settled_fits(std::span<const BoardPair> pairs,
                                   std::span<const Pose> hypotheses, double inlier_px) {
  std::vector<BoardFit> fits;
  std::set<std::vector<std::size_t>>
      tried;  // what agrees roughly ends in the same fit, flips aside
  bool all_agree = false;
  const auto add = [&](const Pose& start) {
    auto fit = settle(pairs, start, inlier_px);
    if (!fit) return;
    all_agree = all_agree || fit->pairs.size() == pairs.size();
    fits.push_back(std::move(*fit));
  };
  for (const Pose& start : hypotheses) {
    if (tried.size() == kMaxSettled || all_agree) break;
    if (tried.insert(agreement(pairs, start, kRough * inlier_px).pairs).second) add(start);
  }
  const auto best_first = [&](const BoardFit& a, const BoardFit& b) {
    const std::size_t points_a = a.points(pairs), points_b = b.points(pairs);
    return points_a != points_b ? points_a > points_b : a.fit.chi_square < b.fit.chi_square;
  };
  std::ranges::stable_sort(fits, best_first);
  if (fits.empty() || all_agree) return fits;
  for (const Pose& flip : mirrored_poses(pairs, fits.front())) add(flip);
  std::ranges::stable_sort(fits, best_first);
  return fits;
}

}  // namespace vantage::reconstruction::detail
