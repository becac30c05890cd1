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

namespace vantage::detail {
namespace {

constexpr double kLossSigmas = 5;  // Gaussian noise loses next to nothing by it
constexpr int kMostSteps = 10;
constexpr int kModelRounds = 3;  // weights follow from residuals, and residuals from weights

PointTerm point_term(const Reading& reading) {
  const SeenPoints& seen = *reading.sighting->points();
  return {&reading.sighting->view->lens, reading.sighting->T_cam_world, reading.points_m,
          seen.pixels, seen.sigma_px};
}

/// With the feature's frame turned around the type's axes of symmetry to where it was measured.
PoseTerm pose_term(const Reading& reading, const Pose& T_world_object) {
  const SeenPose& seen = *reading.sighting->pose();
  const Pose measured = *reading.sighting->view->T_world_cam * seen.T_cam_feature;
  const Pose like_measured =
      turned_towards(reading.type(), T_world_object, measured * reading.T_object_feature.inverse());
  return {measured, T_world_object.inverse() * like_measured * reading.T_object_feature,
          seen.sigma_m, seen.sigma_rad};
}

Pose robust_pose(const Explanation& explanation) {
  std::vector<PointTerm> points;
  std::vector<PoseTerm> poses;
  for (const Reading* reading : explanation.readings) {
    if (reading->sighting->points()) {
      points.push_back(point_term(*reading));
    } else {
      poses.push_back(pose_term(*reading, explanation.T_world_object));
    }
  }
  const auto fit = fit_pose(points, poses, explanation.T_world_object, kLossSigmas);
  return fit ? fit->T_ref_body : explanation.T_world_object;
}

/// The residuals of a view's readings, one below the other, with their derivatives.
struct ViewResiduals {
  Eigen::VectorXd residual, sigma;
  Eigen::Matrix<double, Eigen::Dynamic, 6> by_object, by_camera;

  void add(const Eigen::VectorXd& r, double s, const Eigen::MatrixXd& object,
           const Eigen::MatrixXd& camera) {
    const Eigen::Index before = residual.size(), rows = r.size();
    residual.conservativeResize(before + rows);
    sigma.conservativeResize(before + rows);
    by_object.conservativeResize(before + rows, 6);
    by_camera.conservativeResize(before + rows, 6);
    residual.tail(rows) = r;
    sigma.tail(rows).setConstant(s);
    by_object.bottomRows(rows) = object;
    by_camera.bottomRows(rows) = camera;
  }
};

void add_points(const Reading& reading, const Pose& T_world_object, double model_px,
                ViewResiduals& residuals) {
  const PointTerm term = point_term(reading);
  Eigen::VectorXd r(2 * Eigen::Index(term.pixels.size()));
  for (std::size_t i = 0; i < term.pixels.size(); ++i) {
    const Eigen::Vector3d p = term.T_cam_ref * (T_world_object * term.points_m[i]);
    r.segment<2>(2 * Eigen::Index(i)) = reading.sighting->lens->project(p) - term.pixels[i];
  }
  residuals.add(r, std::hypot(term.sigma_px, model_px), jacobian(term, T_world_object),
                camera_jacobian(term, T_world_object));
}

void add_pose(const Reading& reading, const Pose& T_world_object, ViewResiduals& residuals) {
  const PoseTerm term = pose_term(reading, T_world_object);
  const Pose expected = T_world_object * term.T_body_feature;
  const Eigen::Vector3d t = expected.translation() - term.T_ref_feature.translation();
  const Eigen::Vector3d r =
      rotation_vector(expected.rotation() * term.T_ref_feature.rotation().transpose());
  const Eigen::Matrix<double, 3, 6> move =
      carried_along(expected.translation() - T_world_object.translation()).topRows<3>();
  Eigen::Matrix<double, 3, 6> turn;
  turn << Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Identity();
  const Eigen::Vector3d& camera = reading.sighting->view->T_world_cam->translation();
  const Eigen::Matrix<double, 3, 6> camera_move =
      -carried_along(term.T_ref_feature.translation() - camera).topRows<3>();
  residuals.add(t, term.sigma_m, move, camera_move);
  residuals.add(r, term.sigma_rad, turn, -turn);
}

/// JᵀS⁻¹J, JᵀS⁻¹r and rᵀS⁻¹r.
struct Normal {
  Matrix6d information = Matrix6d::Zero();
  Vector6d slope = Vector6d::Zero();
  double chi_square = 0;
};

/// `model_px` adds to the noise of points.
Normal normal_equations(const Explanation& explanation, double model_px) {
  std::map<std::size_t, ViewResiduals> views;
  std::map<std::size_t, const CameraView*> cameras;
  for (const Reading* reading : explanation.readings) {
    const std::size_t view = reading->sighting->id.view;
    cameras[view] = reading->sighting->view;
    if (reading->sighting->points()) {
      add_points(*reading, explanation.T_world_object, model_px, views[view]);
    } else {
      add_pose(*reading, explanation.T_world_object, views[view]);
    }
  }
  Normal normal;
  for (const auto& [view, v] : views) {
    Eigen::MatrixXd s = v.by_camera * cameras[view]->covariance * v.by_camera.transpose();
    s.diagonal() += v.sigma.cwiseAbs2();
    const Eigen::LLT<Eigen::MatrixXd> solver(s);
    normal.information += v.by_object.transpose() * solver.solve(v.by_object);
    normal.slope += v.by_object.transpose() * solver.solve(v.residual);
    normal.chi_square += v.residual.dot(solver.solve(v.residual));
  }
  return normal;
}

bool exact_cameras(const Explanation& explanation) {
  return std::all_of(explanation.readings.begin(), explanation.readings.end(),
                     [](const Reading* r) { return r->sighting->view->covariance.isZero(0); });
}

/// Gauss–Newton from a pose that is all but there.
void polish(Explanation& explanation, double model_px) {
  for (int step = 0; step < kMostSteps; ++step) {
    const Normal normal = normal_equations(explanation, model_px);
    const Eigen::LDLT<Matrix6d> solver(normal.information);
    if (!(solver.rcond() > 1e-15)) return;
    const Vector6d move = -solver.solve(normal.slope);
    if (!(move.norm() < 0.1)) return;  // also for NaN
    explanation.T_world_object = moved(explanation.T_world_object, move);
    if (move.norm() < 1e-10) return;
  }
}

void weigh_again(Explanation& explanation) {
  explanation.sum = {};
  for (std::size_t i = 0; i < explanation.readings.size(); ++i) {
    explanation.each[i] = evidence_of(*explanation.readings[i], explanation.T_world_object, 0);
    explanation.sum.add(explanation.each[i]);
  }
}

int degrees_of_freedom(const Explanation& explanation) {
  int residuals = 0;
  for (const Reading* reading : explanation.readings) {
    residuals += reading->sighting->pose() ? 6 : 2 * int(reading->points_m.size());
  }
  return std::max(0, residuals - 6);
}

/// The residuals of all points at the pose.
std::vector<PointResidual> point_residuals(const Explanation& explanation) {
  std::vector<PointResidual> residuals;
  for (const Reading* reading : explanation.readings) {
    if (!reading->sighting->points()) continue;
    const PointTerm term = point_term(*reading);
    for (const double px : residuals_px(term, explanation.T_world_object)) {
      residuals.push_back({px * px, term.sigma_px});
    }
  }
  return residuals;
}

}  // namespace

FinalFit fit_finally(Explanation explanation) {
  explanation.T_world_object = robust_pose(explanation);
  const bool exact = exact_cameras(explanation);
  if (!exact) polish(explanation, 0);
  Normal normal = normal_equations(explanation, 0);
  const double chi_square = normal.chi_square;
  const int freedom = degrees_of_freedom(explanation);
  for (int round = 0; round < kModelRounds && freedom > 0; ++round) {
    if (chi_square <= freedom * unlikely_ratio(freedom)) break;
    const double model_px = model_error_px(point_residuals(explanation), freedom);
    polish(explanation, model_px);
    normal = normal_equations(explanation, model_px);
  }
  weigh_again(explanation);
  FinalFit fit{std::move(explanation), {}, chi_square, freedom};
  fit.covariance = covariance_of(without_symmetric_turns(fit.explanation, normal.information));
  const double ratio = normal.chi_square / std::max(1, freedom);  // of measured poses, above all
  if (freedom > 0 && ratio > unlikely_ratio(freedom)) fit.covariance *= ratio;
  return fit;
}

}  // namespace vantage::detail
