#include "pose/pose_fit.hpp"

#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <numbers>

#include "pose/extrapolated_lens.hpp"
#include "pose/pose_costs.hpp"
#include "pose/pose_manifold.hpp"

namespace vantage::reconstruction::detail {
namespace {

bool is_sound(const PointTerm& term) {
  const auto finite = [](const auto& point) { return point.allFinite(); };
  return term.lens && term.sigma_px > 0 && std::isfinite(term.sigma_px) &&
         term.points_m.size() == term.pixels.size() && std::ranges::all_of(term.points_m, finite) &&
         std::ranges::all_of(term.pixels, finite);
}

bool is_sound(const PoseTerm& term) {
  return term.sigma_m > 0 && term.sigma_rad > 0 && std::isfinite(term.sigma_m) &&
         std::isfinite(term.sigma_rad);
}

/// The loss of a term acts on its mean squared residual per coordinate: it is right or wrong as a
/// whole, as a marker is.
double loss_scale(double loss_sigmas, std::size_t residuals) {
  return loss_sigmas * std::sqrt(double(residuals));
}

/// A problem of Ceres' and what it refers to.
class FitProblem {
 public:
  FitProblem(std::span<const PointTerm> points, std::span<const PoseTerm> poses, const Pose& start,
             double loss_sigmas)
      : parameters_(parameters_of(start)), loss_sigmas_(loss_sigmas), problem_(options()) {
    problem_.AddParameterBlock(parameters_.data(), 7, &manifold_);
    for (const PointTerm& term : points) {
      if (!term.points_m.empty()) add(point_costs_.emplace_back(term));
    }
    for (const PoseTerm& term : poses) add(pose_costs_.emplace_back(term));
  }

  bool empty() const { return point_costs_.empty() && pose_costs_.empty(); }

  /// Moves the parameters; whether it got to the end.
  bool solve() {
    ceres::Solver::Options options;
    options.logging_type = ceres::SILENT;
    options.num_threads = 1;
    options.linear_solver_type = ceres::DENSE_QR;
    options.max_num_iterations = 100;
    options.function_tolerance = 1e-12;
    options.gradient_tolerance = 1e-12;
    options.parameter_tolerance = 1e-12;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    return summary.termination_type == ceres::CONVERGENCE;
  }

  Pose pose() const { return pose_of(parameters_.data()); }

 private:
  static ceres::Problem::Options options() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;  // a quarter of the time of a small problem
    return options;
  }

  void add(ceres::CostFunction& cost) {
    ceres::LossFunction* loss = nullptr;
    if (loss_sigmas_ > 0) {
      loss = &losses_.emplace_back(loss_scale(loss_sigmas_, std::size_t(cost.num_residuals())));
    }
    problem_.AddResidualBlock(&cost, loss, parameters_.data());
  }

  PoseParameters parameters_;
  double loss_sigmas_;
  PoseManifold manifold_;
  std::deque<PointCost> point_costs_;
  std::deque<PoseCost> pose_costs_;
  std::deque<ceres::CauchyLoss> losses_;
  ceres::Problem problem_;  // last: it refers to the others
};

/// By how much the loss turns down a term.
double loss_weight(double loss_sigmas, double chi_square, std::size_t residuals) {
  if (!(loss_sigmas > 0)) return 1;
  const double scale = loss_scale(loss_sigmas, residuals);
  return 1 / (1 + chi_square / (scale * scale));
}

/// Adds a term's residuals and derivatives (by the seven parameters) to a fit's.
void add_term(const ceres::CostFunction& cost, const Pose& pose, double loss_sigmas, PoseFit& fit,
              Eigen::VectorXd& residuals) {
  const PoseParameters parameters = parameters_of(pose);
  const double* blocks[] = {parameters.data()};
  residuals.resize(cost.num_residuals());
  Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor> by_parameters(residuals.size(), 7);
  double* jacobians[] = {by_parameters.data()};
  cost.Evaluate(blocks, residuals.data(), jacobians);
  Eigen::Matrix<double, 7, 6, Eigen::RowMajor> by_step;
  PoseManifold().PlusJacobian(parameters.data(), by_step.data());
  const Eigen::Matrix<double, Eigen::Dynamic, 6> j = by_parameters * by_step;
  const double chi_square = residuals.squaredNorm();
  const double weight = loss_weight(loss_sigmas, chi_square, std::size_t(residuals.size()));
  fit.chi_square += chi_square;
  fit.information += weight * j.transpose() * j;
}

bool all_before(const PointTerm& term, const Pose& T_ref_body) {
  const Pose T_cam_body = term.T_cam_ref * T_ref_body;
  return std::ranges::all_of(term.points_m,
                             [&](const auto& p) { return is_before(T_cam_body * p); });
}

/// Two rows for each point, by `rows_of(lens, p_body)`.
template <class Rows>
Eigen::Matrix<double, Eigen::Dynamic, 6> by_points(const PointTerm& term, const Rows& rows_of) {
  const WideLens lens(*term.lens);
  Eigen::Matrix<double, Eigen::Dynamic, 6> result(2 * Eigen::Index(term.points_m.size()), 6);
  for (std::size_t i = 0; i < term.points_m.size(); ++i) {
    result.middleRows<2>(2 * Eigen::Index(i)) = rows_of(lens, term.points_m[i]);
  }
  return result;
}

}  // namespace

std::optional<PoseFit> fit_pose(std::span<const PointTerm> points, std::span<const PoseTerm> poses,
                                const Pose& start, double loss_sigmas) {
  const auto sound = [](const auto& term) { return is_sound(term); };
  if (!std::ranges::all_of(points, sound) || !std::ranges::all_of(poses, sound)) return {};
  FitProblem problem(points, poses, start, loss_sigmas);
  if (problem.empty()) return {};
  PoseFit fit;
  fit.converged = problem.solve();
  fit.T_ref_body = problem.pose();
  if (!std::ranges::all_of(points, [&](const auto& p) { return all_before(p, fit.T_ref_body); })) {
    return {};
  }
  Eigen::VectorXd residuals;
  double square_px = 0;
  std::size_t count = 0;
  for (const PointTerm& term : points) {
    add_term(PointCost(term), fit.T_ref_body, loss_sigmas, fit, residuals);
    const double square = residuals.squaredNorm() * term.sigma_px * term.sigma_px;
    const std::size_t n = std::max(term.points_m.size(), std::size_t(1));
    fit.rms_px_of_term.push_back(std::sqrt(square / double(n)));
    square_px += square, count += term.points_m.size();
  }
  for (const PoseTerm& term : poses) {
    add_term(PoseCost(term), fit.T_ref_body, loss_sigmas, fit, residuals);
  }
  fit.rms_px = count ? std::sqrt(square_px / double(count)) : 0;
  return fit;
}

std::vector<double> residuals_px(const PointTerm& term, const Pose& T_ref_body) {
  const WideLens lens(*term.lens);
  const Pose T_cam_body = term.T_cam_ref * T_ref_body;
  std::vector<double> result;
  for (std::size_t i = 0; i < term.points_m.size(); ++i) {
    const Eigen::Vector3d p = T_cam_body * term.points_m[i];
    result.push_back(is_before(p) ? (lens.project(p) - term.pixels[i]).norm()
                                  : std::numeric_limits<double>::infinity());
  }
  return result;
}

Eigen::Matrix<double, Eigen::Dynamic, 6> jacobian(const PointTerm& term, const Pose& T_ref_body) {
  return by_points(term, [&](const WideLens& lens, const Eigen::Vector3d& p_body) {
    const Eigen::Vector3d arm = T_ref_body.rotation() * p_body;
    Eigen::Matrix<double, 2, 3> by_point;
    lens.project(term.T_cam_ref * (arm + T_ref_body.translation()), &by_point);
    by_point = (by_point * term.T_cam_ref.rotation()).eval();
    Eigen::Matrix<double, 2, 6> rows;
    rows << by_point, -by_point * cross_matrix(arm);
    return rows;
  });
}

Eigen::Matrix<double, Eigen::Dynamic, 6> camera_jacobian(const PointTerm& term,
                                                         const Pose& T_ref_body) {
  const Pose T_world_cam = term.T_cam_ref.inverse();
  return by_points(term, [&](const WideLens& lens, const Eigen::Vector3d& p_body) {
    const Eigen::Vector3d p_world = T_ref_body * p_body;
    Eigen::Matrix<double, 2, 3> by_point;
    lens.project(term.T_cam_ref * p_world, &by_point);
    by_point = (by_point * term.T_cam_ref.rotation()).eval();
    Eigen::Matrix<double, 2, 6> rows;
    rows << -by_point, by_point * cross_matrix(p_world - T_world_cam.translation());
    return rows;
  });
}

Matrix6d covariance_of(const Matrix6d& information) {
  // Metres and radians have no common scale: what is singular shows once the diagonal is 1.
  const Eigen::Matrix<double, 6, 1> most(1, 1, 1, std::numbers::pi, std::numbers::pi,
                                         std::numbers::pi);
  const Matrix6d scaled = most.asDiagonal() * information * most.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Matrix6d> eigen(scaled);
  // An eigenvalue of 1 is a variance of 1 m² or (π rad)²; nothing is less well known.
  const double noise = 1e-12 * std::max(eigen.eigenvalues().maxCoeff(), 0.0);
  Eigen::Matrix<double, 6, 1> variances;
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double value = eigen.eigenvalues()[i];
    variances[i] = value > std::max(noise, 1.0) ? 1 / value : 1;
  }
  const Matrix6d vectors = most.asDiagonal() * eigen.eigenvectors();
  return vectors * variances.asDiagonal() * vectors.transpose();
}

}  // namespace vantage::reconstruction::detail
