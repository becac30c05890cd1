#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "vantage/raycore/lens.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/reconstruction/observation.hpp"

namespace vantage::reconstruction::detail {

/// Points of a body whose pose `T_ref_body` is looked for, as one camera sees them:
/// pixel ≈ lens.project(T_cam_ref * T_ref_body * point). For an object the reference is the world;
/// for a camera that looks for itself, the body is the world and the reference the camera.
struct PointTerm {
  const Lens* lens = nullptr;
  Pose T_cam_ref;
  std::vector<Eigen::Vector3d> points_m;
  std::vector<Eigen::Vector2d> pixels;
  double sigma_px = 1;
};

/// A measured pose of a frame on the body: T_ref_feature ≈ T_ref_body * T_body_feature.
struct PoseTerm {
  Pose T_ref_feature;
  Pose T_body_feature;
  double sigma_m = 1;
  double sigma_rad = 1;
};

/// The pose that explains all terms best.
struct PoseFit {
  Pose T_ref_body;
  Matrix6d information = Matrix6d::Zero();  ///< JᵀWJ at the solution, by (t, r) as Matrix6d has it
  double chi_square = 0;                    ///< Σ (residual / sigma)², without the loss
  double rms_px = 0;  ///< over all points: the root of the mean squared distance
  std::vector<double> rms_px_of_term = {};  ///< of each PointTerm
  bool converged = false;
};

/// Minimises Σ loss((residual / sigma)²) with Ceres (Levenberg–Marquardt on SE(3), analytic
/// derivatives, one thread). The loss is Cauchy's beyond `loss_sigmas` standard deviations; 0:
/// none. Nothing if a point never comes before its camera. Deterministic; thread-safe.
std::optional<PoseFit> fit_pose(std::span<const PointTerm> points, std::span<const PoseTerm> poses,
                                const Pose& start, double loss_sigmas);

/// Distance in pixels of each point of a term for a pose; infinite behind the camera.
std::vector<double> residuals_px(const PointTerm& term, const Pose& T_ref_body);

/// The derivatives of a term's residuals (2 rows for each point, in pixels, not divided by sigma)
/// by (t, r) of T_ref_body as Matrix6d has it. All points have to be before the camera.
Eigen::Matrix<double, Eigen::Dynamic, 6> jacobian(const PointTerm& term, const Pose& T_ref_body);

/// What the camera's own pose does to the residuals: their derivatives by (t, r) of T_world_cam,
/// for a term whose reference is the world.
Eigen::Matrix<double, Eigen::Dynamic, 6> camera_jacobian(const PointTerm& term,
                                                         const Pose& T_ref_body);

/// The inverse of an information matrix, singular directions (of which nothing is known) left as
/// large variances: 1 m² and (π rad)².
Matrix6d covariance_of(const Matrix6d& information);

}  // namespace vantage::reconstruction::detail
