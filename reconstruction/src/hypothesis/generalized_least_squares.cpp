#include "hypothesis/generalized_least_squares.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "hypothesis/canonical_pose.hpp"
#include "pose/excess_variance.hpp"
#include "pose/pose_fit.hpp"
#include "pose/rigid_motion.hpp"
#include "pose/symmetry.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kLossSigmas = 5;  // Gaussian noise loses next to nothing by it
constexpr int kMaxSteps = 10;
constexpr int kModelRounds = 3;  // weights follow from residuals, and residuals from weights

PointTerm point_term(const Correspondence& correspondence) {
  const SeenPoints& seen = *correspondence.measurement->points();
  return {&correspondence.measurement->view->lens, correspondence.measurement->T_cam_world,
          correspondence.points_m, seen.pixels, seen.sigma_px};
}

/// With the feature's frame turned around the type's axes of symmetry to where it was measured.
PoseTerm pose_term(const Correspondence& correspondence, const Pose& T_world_object) {
  const SeenPose& seen = *correspondence.measurement->pose();
  const Pose measured = *correspondence.measurement->view->T_world_cam * seen.T_cam_feature;
  const Pose like_measured = turned_towards(correspondence.type(), T_world_object,
                                            measured * correspondence.T_object_feature.inverse());
  return {measured, T_world_object.inverse() * like_measured * correspondence.T_object_feature,
          seen.sigma_m, seen.sigma_rad};
}

Pose robust_pose(const PoseHypothesis& hypothesis) {
  std::vector<PointTerm> points;
  std::vector<PoseTerm> poses;
  for (const Correspondence* correspondence : hypothesis.correspondences) {
    if (correspondence->measurement->points()) {
      points.push_back(point_term(*correspondence));
    } else {
      poses.push_back(pose_term(*correspondence, hypothesis.T_world_object));
    }
  }
  const auto fit = fit_pose(points, poses, hypothesis.T_world_object, kLossSigmas);
  return fit ? fit->T_ref_body : hypothesis.T_world_object;
}

/// The residuals of a view's correspondences, one below the other, with their derivatives.
struct ViewResiduals {
  Eigen::VectorXd residual, sigma, noise;  ///< `noise`: of sigma, what is new in every picture
  Eigen::Matrix<double, Eigen::Dynamic, 6> by_object, by_camera;

  void add(const Eigen::VectorXd& r, double s, double n, const Eigen::MatrixXd& object,
           const Eigen::MatrixXd& camera) {
    const Eigen::Index before = residual.size(), rows = r.size();
    residual.conservativeResize(before + rows);
    sigma.conservativeResize(before + rows);
    noise.conservativeResize(before + rows);
    by_object.conservativeResize(before + rows, 6);
    by_camera.conservativeResize(before + rows, 6);
    residual.tail(rows) = r;
    sigma.tail(rows).setConstant(s);
    noise.tail(rows).setConstant(n);
    by_object.bottomRows(rows) = object;
    by_camera.bottomRows(rows) = camera;
  }
};

void add_points(const Correspondence& correspondence, const Pose& T_world_object, double model_px,
                ViewResiduals& residuals) {
  const PointTerm term = point_term(correspondence);
  Eigen::VectorXd r(2 * Eigen::Index(term.pixels.size()));
  for (std::size_t i = 0; i < term.pixels.size(); ++i) {
    const Eigen::Vector3d p = term.T_cam_ref * (T_world_object * term.points_m[i]);
    r.segment<2>(2 * Eigen::Index(i)) =
        correspondence.measurement->lens->project(p) - term.pixels[i];
  }
  residuals.add(r, std::hypot(term.sigma_px, model_px), term.sigma_px,
                jacobian(term, T_world_object), camera_jacobian(term, T_world_object));
}

void add_pose(const Correspondence& correspondence, const Pose& T_world_object,
              ViewResiduals& residuals) {
  const PoseTerm term = pose_term(correspondence, T_world_object);
  const Pose expected = T_world_object * term.T_body_feature;
  const Eigen::Vector3d t = expected.translation() - term.T_ref_feature.translation();
  const Eigen::Vector3d r =
      rotation_vector(expected.rotation() * term.T_ref_feature.rotation().transpose());
  const Eigen::Matrix<double, 3, 6> move =
      carried_along(expected.translation() - T_world_object.translation()).topRows<3>();
  Eigen::Matrix<double, 3, 6> turn;
  turn << Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Identity();
  const Eigen::Vector3d& camera = correspondence.measurement->view->T_world_cam->translation();
  const Eigen::Matrix<double, 3, 6> camera_move =
      -carried_along(term.T_ref_feature.translation() - camera).topRows<3>();
  residuals.add(t, term.sigma_m, term.sigma_m, move, camera_move);
  residuals.add(r, term.sigma_rad, term.sigma_rad, turn, -turn);
}

/// JᵀS⁻¹J, JᵀS⁻¹r and rᵀS⁻¹r; and JᵀS⁻¹NS⁻¹J with the noise N of the observations alone.
struct Normal {
  Matrix6d information = Matrix6d::Zero(), noise = Matrix6d::Zero();
  Vector6d gradient = Vector6d::Zero();
  double chi_square = 0;
};

/// `model_px` adds to the noise of points.
Normal normal_equations(const PoseHypothesis& hypothesis, double model_px) {
  std::map<std::size_t, ViewResiduals> views;
  std::map<std::size_t, const CameraView*> cameras;
  for (const Correspondence* correspondence : hypothesis.correspondences) {
    const std::size_t view = correspondence->measurement->id.view;
    cameras[view] = correspondence->measurement->view;
    if (correspondence->measurement->points()) {
      add_points(*correspondence, hypothesis.T_world_object, model_px, views[view]);
    } else {
      add_pose(*correspondence, hypothesis.T_world_object, views[view]);
    }
  }
  Normal normal;
  for (const auto& [view, v] : views) {
    Eigen::MatrixXd s = v.by_camera * cameras[view]->covariance * v.by_camera.transpose();
    s.diagonal() += v.sigma.cwiseAbs2();
    const Eigen::LLT<Eigen::MatrixXd> solver(s);
    const Eigen::Matrix<double, Eigen::Dynamic, 6> weighted = solver.solve(v.by_object);
    normal.information += v.by_object.transpose() * weighted;
    normal.noise += weighted.transpose() * v.noise.cwiseAbs2().asDiagonal() * weighted;
    normal.gradient += v.by_object.transpose() * solver.solve(v.residual);
    normal.chi_square += v.residual.dot(solver.solve(v.residual));
  }
  return normal;
}

bool exact_cameras(const PoseHypothesis& hypothesis) {
  return std::all_of(
      hypothesis.correspondences.begin(), hypothesis.correspondences.end(),
      [](const Correspondence* r) { return r->measurement->view->covariance.isZero(0); });
}

/// Gauss–Newton from a pose that is all but there.
void polish(PoseHypothesis& hypothesis, double model_px) {
  for (int step = 0; step < kMaxSteps; ++step) {
    const Normal normal = normal_equations(hypothesis, model_px);
    const Eigen::LDLT<Matrix6d> solver(normal.information);
    if (!(solver.rcond() > 1e-15)) return;
    const Vector6d move = -solver.solve(normal.gradient);
    if (!(move.norm() < 0.1)) return;  // also for NaN
    hypothesis.T_world_object = moved(hypothesis.T_world_object, move);
    if (move.norm() < 1e-10) return;
  }
}

void weigh_again(PoseHypothesis& hypothesis) {
  hypothesis.sum = {};
  for (std::size_t i = 0; i < hypothesis.correspondences.size(); ++i) {
    hypothesis.each[i] =
        linear_system_of(*hypothesis.correspondences[i], hypothesis.T_world_object, 0);
    hypothesis.sum.add(hypothesis.each[i]);
  }
}

int degrees_of_freedom(const PoseHypothesis& hypothesis) {
  int residuals = 0;
  for (const Correspondence* correspondence : hypothesis.correspondences) {
    residuals += correspondence->measurement->pose() ? 6 : 2 * int(correspondence->points_m.size());
  }
  return std::max(0, residuals - 6);
}

/// The residuals of all points at the pose.
std::vector<PointResidual> point_residuals(const PoseHypothesis& hypothesis) {
  std::vector<PointResidual> residuals;
  for (const Correspondence* correspondence : hypothesis.correspondences) {
    if (!correspondence->measurement->points()) continue;
    const PointTerm term = point_term(*correspondence);
    for (const double px : residuals_px(term, hypothesis.T_world_object)) {
      residuals.push_back({px * px, term.sigma_px});
    }
  }
  return residuals;
}

}  // namespace

FinalFit generalized_least_squares(PoseHypothesis hypothesis) {
  hypothesis.T_world_object = robust_pose(hypothesis);
  const bool exact = exact_cameras(hypothesis);
  if (!exact) polish(hypothesis, 0);
  Normal normal = normal_equations(hypothesis, 0);
  const double chi_square = normal.chi_square;
  const int freedom = degrees_of_freedom(hypothesis);
  for (int round = 0; round < kModelRounds && freedom > 0; ++round) {
    if (chi_square <= freedom * unlikely_ratio(freedom)) break;
    const double model_px = model_error_px(point_residuals(hypothesis), freedom);
    polish(hypothesis, model_px);
    normal = normal_equations(hypothesis, model_px);
  }
  weigh_again(hypothesis);
  FinalFit fit{std::move(hypothesis), {}, {}, chi_square, freedom};
  const Matrix6d all = covariance_of(normal.information);
  fit.noise = all * normal.noise * all;
  fit.covariance = covariance_of(without_symmetric_turns(fit.hypothesis, normal.information));
  const double ratio = normal.chi_square / std::max(1, freedom);  // of measured poses, above all
  if (freedom > 0 && ratio > unlikely_ratio(freedom)) fit.covariance *= ratio;
  return fit;
}

}  // namespace vantage::reconstruction::detail
