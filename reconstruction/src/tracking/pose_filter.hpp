#pragma once

#include "hypothesis/linear_system.hpp"
#include "vantage/reconstruction/object_type.hpp"

namespace vantage::reconstruction::detail {

/// A measured pose, with its error in two parts.
struct PoseMeasurement {
  Pose T_world_object;
  Matrix6d noise = Matrix6d::Identity();  ///< another one in every picture
  Matrix6d common = Matrix6d::Zero();     ///< the same in all pictures of the cameras
};

/// An error-state Kalman filter for the pose of an object that stands still: translation and
/// rotation as Matrix6d has them. What all pictures have in common is no noise, and is carried
/// along without becoming smaller (Schmidt 1966: considered, not estimated).
class PoseFilter {
 public:
  explicit PoseFilter(const PoseMeasurement& first) : state_(first) {}

  const Pose& pose() const { return state_.T_world_object; }
  const PoseMeasurement& state() const { return state_; }
  Matrix6d covariance() const { return state_.noise + state_.common; }

  /// Time goes by: the object may have crept by these standard deviations.
  void predict(double creep_m, double creep_rad);

  /// How far a measurement is from where the object is expected, as Matrix6d has it.
  Vector6d innovation(const PoseMeasurement& measured) const;

  /// Its covariance. Where the same cameras measured, their common errors cancel, nearly.
  Matrix6d innovation_covariance(const PoseMeasurement& measured, bool same_cameras) const;

  void update(const PoseMeasurement& measured);

 private:
  PoseMeasurement state_;
};

/// Of a normal distribution, in natural units (m³ rad³).
struct NormalLikelihood {
  double squared_distance = 0;  ///< Mahalanobis
  double negative_log = 0;      ///< of the density
};
NormalLikelihood likelihood_of(const Vector6d& innovation, const Matrix6d& covariance);

/// The nearest matrix without negative variances.
Matrix6d without_negative(const Matrix6d& symmetric);

/// Of the poses that look the same by the type's symmetries, that nearest to `target`.
Pose nearest_equal_pose(const ObjectType& type, const Pose& pose, const Pose& target);

}  // namespace vantage::reconstruction::detail
