#include "locate/planar_ambiguity.hpp"

#include <algorithm>
#include <cmath>

#include "pose/excess_variance.hpp"
#include "pose/pose_manifold.hpp"
#include "pose/principal_axes.hpp"

namespace vantage::detail {
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

double freedom_of(std::size_t points) {
  return std::max(2 * double(points) - 6, 1.0);
}

double excess_of(double chi_square, std::size_t points) {
  return std::max(chi_square / freedom_of(points), 1.0);
}

}  // namespace vantage::detail
