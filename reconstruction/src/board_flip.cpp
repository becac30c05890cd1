#include "board_flip.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace vantage::detail {
namespace {

Eigen::Matrix3d mirror(const Eigen::Vector3d& normal) {
  return Eigen::Matrix3d::Identity() - 2 * normal * normal.transpose();
}

}  // namespace

std::vector<Pose> mirrored_poses(std::span<const BoardPair> all, const BoardFit& board) {
  const double count = double(board.points(all));
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const std::size_t i : board.pairs) {
    for (const Eigen::Vector3d& p : all[i].term.points_m) centre += p / count;
  }
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (const std::size_t i : board.pairs) {
    for (const Eigen::Vector3d& p : all[i].term.points_m) {
      scatter += (p - centre) * (p - centre).transpose();
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(scatter);
  const Eigen::Vector3d centre_cam = board.T_cam_world() * centre;
  const Eigen::Matrix3d across_sight = mirror(centre_cam.normalized());
  std::vector<Pose> poses;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Matrix3d rotation =
        across_sight * board.T_cam_world().rotation() * mirror(axes.eigenvectors().col(axis));
    poses.push_back(Pose::from_rotation(rotation, centre_cam - rotation * centre));
  }
  return poses;
}

bool differ(const Pose& a, const Pose& b) {
  constexpr double kSame = 1e-4;  // radians, and parts of the distance
  const double turn =
      Eigen::AngleAxisd(Eigen::Matrix3d(a.rotation() * b.rotation().transpose())).angle();
  const Eigen::Vector3d eye_a = a.inverse().translation(), eye_b = b.inverse().translation();
  return turn > kSame || (eye_a - eye_b).norm() > kSame * a.translation().norm();
}

std::vector<PoseFit> other_minima(std::span<const BoardPair> all, const BoardFit& board,
                                  std::span<const Pose> starts) {
  std::vector<PoseFit> others;
  for (const Pose& start : starts) {
    const auto fit = fit_pairs(all, board.pairs, start, 0);
    if (!fit || !differ(fit->T_ref_body, board.T_cam_world())) continue;
    const bool known = std::ranges::any_of(
        others, [&](const PoseFit& other) { return !differ(fit->T_ref_body, other.T_ref_body); });
    if (!known) others.push_back(*fit);
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

double significant_excess_of(double chi_square, std::size_t points) {
  // Wilson and Hilferty's approximation of the chi-square distribution's quantile.
  const double kNormalQuantile = 3.09, spread = 2 / (9 * freedom_of(points));
  const double most = std::pow(1 - spread + kNormalQuantile * std::sqrt(spread), 3);
  const double excess = excess_of(chi_square, points);
  return excess > most ? excess : 1;
}

}  // namespace vantage::detail
