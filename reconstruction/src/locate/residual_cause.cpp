#include "locate/residual_cause.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "locate/golden_section.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kNotNoise = 1.5;  ///< times the corners' noise

/// A model with one parameter; 0 is what was given.
struct Deviation {
  std::function<std::vector<BoardPair>(double)> apply;  ///< empty: there is no such lens
  std::function<std::string(double)> text;
  double bound;  ///< the parameter is looked for between -bound and bound
};

/// Keeps the lens that the pairs point to.
struct DeviationSearch {
  std::span<const BoardPair> pairs;
  std::optional<Lens> lens = {};

  std::vector<BoardPair> with_lens(const Intrinsics& k, const Distortion& d) {
    try {
      lens.emplace(k, d);
    } catch (const Error&) {
      return {};
    }
    std::vector<BoardPair> result(pairs.begin(), pairs.end());
    for (BoardPair& pair : result) pair.term.lens = &*lens;
    return result;
  }

  std::vector<BoardPair> with_points(
      const std::function<void(std::vector<Eigen::Vector3d>&)>& change) const {
    std::vector<BoardPair> result(pairs.begin(), pairs.end());
    for (BoardPair& pair : result) change(pair.term.points_m);
    return result;
  }
};

struct Board {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  double radius_m = 0;
};

Board board_of(std::span<const BoardPair> pairs, const BoardFit& fit) {
  Board board;
  std::size_t count = 0;
  for (const std::size_t i : fit.pairs) {
    for (const Eigen::Vector3d& point : pairs[i].term.points_m) board.centre += point, ++count;
  }
  board.centre /= double(count);
  for (const std::size_t i : fit.pairs) {
    for (const Eigen::Vector3d& point : pairs[i].term.points_m) {
      board.radius_m = std::max(board.radius_m, (point - board.centre).head<2>().norm());
    }
  }
  return board;
}

Deviation bend_along(DeviationSearch& search, const Board& board, double angle) {
  const Eigen::Vector3d across(std::cos(angle), std::sin(angle), 0);
  return {[&search, board, across](double height_m) {
            return search.with_points([&](std::vector<Eigen::Vector3d>& points) {
              for (Eigen::Vector3d& point : points) {
                const double along = across.dot(point - board.centre) / board.radius_m;
                point.z() += height_m * along * along;
              }
            });
          },
          [](double height_m) {
            return fmt::format("the board is bent by {:.1f} mm", 1e3 * std::abs(height_m));
          },
          0.2 * board.radius_m};
}

std::vector<Deviation> deviations(DeviationSearch& search, const Lens& lens, const Board& board) {
  std::vector<Deviation> all;
  all.push_back({[&search, lens](double by) {
                   Intrinsics k = lens.intrinsics();
                   k.fx *= 1 + by, k.fy *= 1 + by;
                   return search.with_lens(k, lens.distortion());
                 },
                 [](double by) {
                   return fmt::format(
                       "the focal length is {:.3f} times that of the intrinsics ({:+.1f} %)",
                       1 + by, 100 * by);
                 },
                 0.25});
  all.push_back(
      {[&search, lens](double by) {
         Distortion d = lens.distortion();
         d.k1 += by;
         return search.with_lens(lens.intrinsics(), d);
       },
       [](double by) {
         return fmt::format(
             "the lens has an additional radial distortion k1 of {:+.3f}; give --calibration", by);
       },
       0.6});
  all.push_back({[&search](double by) {
                   return search.with_points([&](std::vector<Eigen::Vector3d>& points) {
                     Eigen::Vector3d centre = Eigen::Vector3d::Zero();
                     for (const auto& point : points) centre += point / double(points.size());
                     for (auto& point : points) point = centre + (1 + by) * (point - centre);
                   });
                 },
                 [](double by) {
                   return fmt::format(
                       "the board's markers are {:.3f} times as large as size_m "
                       "says, for the distances between them",
                       1 + by);
                 },
                 0.25});
  for (int eighth = 0; eighth < 4; ++eighth) {
    all.push_back(bend_along(search, board, 0.25 * eighth * double(EIGEN_PI)));
  }
  return all;
}

struct Found {
  double parameter = 0;
  double chi_square = HUGE_VAL;
  Pose T_cam_world;
};

/// The least chi-square over the parameter, by golden sections.
Found least(const Deviation& deviation, const BoardFit& board) {
  constexpr int kSteps = 30;
  Found best;
  const auto cost = [&](double parameter) {
    const std::vector<BoardPair> pairs = deviation.apply(parameter);
    if (pairs.empty()) return HUGE_VAL;
    const auto fit = fit_pairs(pairs, board.pairs, board.T_cam_world(), 0);
    if (!fit) return HUGE_VAL;
    if (fit->chi_square < best.chi_square) best = {parameter, fit->chi_square, fit->T_ref_body};
    return fit->chi_square;
  };
  least_by_golden_section(-deviation.bound, deviation.bound, kSteps, cost);
  return best;
}

}  // namespace

std::optional<ResidualCause> residual_cause(const Lens& lens, std::span<const BoardPair> pairs,
                                            const BoardFit& board) {
  constexpr double kMostOfIt = 0.25;  // of chi-square may be left
  const double freedom = freedom_of(board.points(pairs));
  const double ratio = std::sqrt(board.fit.chi_square / freedom);
  if (ratio < kNotNoise) return std::nullopt;
  ResidualCause result{ratio, {}, board.T_cam_world()};
  if (board.pairs.size() < 2) return result;  // one marker bends, turns and shrinks to fit anything
  DeviationSearch search{pairs};
  double chi_square = kMostOfIt * board.fit.chi_square;
  for (const Deviation& deviation : deviations(search, lens, board_of(pairs, board))) {
    const Found found = least(deviation, board);
    if (found.chi_square >= chi_square) continue;
    chi_square = found.chi_square;
    result.cause = deviation.text(found.parameter);
    result.T_cam_world = found.T_cam_world;
  }
  return result;
}

}  // namespace vantage::reconstruction::detail
