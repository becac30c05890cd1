#pragma once

#include <span>

#include "metrics/tracking/track_frame.hpp"

namespace vantage {

/// The value below which a chi-square variable of so many degrees of freedom is with this
/// probability, by Wilson and Hilferty's approximation (1931): within 1 % from six degrees on.
double chi_square_quantile(double probability, double degrees);

/// Whether covariances are right: the normalised estimation error squared (Bar-Shalom, "Estimation
/// with Applications to Tracking and Navigation", 2001, section 5.4), six for a right covariance.
struct PoseConsistency {
  std::vector<double> nees = {};  ///< samples that are independent of each other

  void add(const PoseConsistency& other);
  double mean() const;
  /// Of the mean of so many samples, with probability 0.95, if the covariances are right.
  double low() const;
  double high() const;
  /// How many samples are below chi-square's 0.95 quantile.
  double coverage() const;
};

/// One sample for each standing of an object: its last estimate. Those of a standing go together,
/// as a filter's errors do; those of different standings do not, if the cameras' poses are exact.
/// Estimates without a covariance are left out.
PoseConsistency pose_consistency(std::span<const TrackFrame> frames,
                                 std::span<const ComparedFrame> compared);

}  // namespace vantage
