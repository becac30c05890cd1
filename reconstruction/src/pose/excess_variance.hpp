#pragma once

#include <span>

namespace vantage::reconstruction::detail {

/// How far a point's pixel is from where a pose has it, and the noise of its coordinates.
struct PointResidual {
  double squared_px = 0;
  double sigma_px = 1;
};

/// The 99.9 % quantile of chi-square over its degrees of freedom (Wilson and Hilferty, 1931).
double unlikely_ratio(double degrees_of_freedom);

/// What calibration, print and shape add to the noise of every coordinate, pixels: the s with which
/// Σ squared / (sigma² + s²) is the degrees of freedom (Paule and Mandel, "Consensus values and
/// weighting factors", 1982). 0 where noise alone explains the residuals.
///
/// With it, points that claim to be very precise no longer outweigh the others by more than they
/// are worth: they share the rest of the error.
double model_error_px(std::span<const PointResidual> residuals, double degrees_of_freedom);

}  // namespace vantage::reconstruction::detail
