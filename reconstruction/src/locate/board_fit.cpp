#include "locate/board_fit.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "pose/excess_variance.hpp"

namespace vantage::detail {
namespace {

constexpr int kMostSelections = 20;
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
  for (int round = 0; round < kMostSelections; ++round) {
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

}  // namespace vantage::detail
