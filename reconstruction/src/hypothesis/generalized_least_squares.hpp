#pragma once

#include "hypothesis/expand_consensus.hpp"

namespace vantage::reconstruction::detail {

/// An hypothesis with its final pose, and how sure that is.
struct FinalFit {
  PoseHypothesis hypothesis;  ///< its evidence with the observations' own standard deviations
  Matrix6d covariance = Matrix6d::Zero();
  Matrix6d noise = Matrix6d::Zero();  ///< the part of it that the observations' noise makes
  double chi_square = 0;
  int degrees_of_freedom = 0;
};

/// Minimises the reprojection error in all views: robustly with the corners' noise; where a view's
/// pose has a covariance, then by generalised least squares, in which the residuals of one view go
/// together as its pose's error moves them (S = W⁻¹ + J_c Σ_c J_cᵀ for the view's residuals).
///
/// The covariance is (Σ JᵀS⁻¹J)⁻¹. Where the residuals are larger than noise makes them in one of a
/// thousand cases, calibration, print or shape are off: what they add to the noise is estimated,
/// and the fit repeated with it (model_error.hpp). `chi_square` stays that of the noise alone.
/// Turns that a continuous symmetry leaves open get large variances, as covariance_of has them.
FinalFit generalized_least_squares(PoseHypothesis hypothesis);

}  // namespace vantage::reconstruction::detail
