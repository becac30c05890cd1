#include "locate/board_hypotheses.hpp"

#include <algorithm>
#include <set>

#include "locate/planar_ambiguity.hpp"
#include "pose/solve_pnp.hpp"

namespace vantage::detail {
namespace {

constexpr std::size_t kMostSettled = 8;

std::vector<PoseGuess> guesses_from_all(std::span<const BoardPair> pairs) {
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector2d> pixels;
  for (const BoardPair& pair : pairs) {
    points.insert(points.end(), pair.term.points_m.begin(), pair.term.points_m.end());
    pixels.insert(pixels.end(), pair.term.pixels.begin(), pair.term.pixels.end());
  }
  if (pairs.empty()) return {};
  return guess_poses(*pairs.front().term.lens, points, pixels);
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
    add(guess_poses(*pair.term.lens, pair.term.points_m, pair.term.pixels));
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
    if (tried.size() == kMostSettled || all_agree) break;
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

}  // namespace vantage::detail
