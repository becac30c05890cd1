#pragma once

#include <Eigen/Core>
#include <functional>

#include "vantage/raycore/pose.hpp"

namespace vantage::test {

using ResidualsOfPose = std::function<Eigen::VectorXd(const Pose&)>;

/// The pose moved by (t, r) as Matrix6d has it.
Pose moved_by(const Pose& pose, const Eigen::Matrix<double, 6, 1>& step);

/// The (t, r) that moves one pose to another.
Eigen::Matrix<double, 6, 1> step_between(const Pose& from, const Pose& to);

/// Derivatives by (t, r): differences of two poses to either side.
Eigen::Matrix<double, Eigen::Dynamic, 6> numeric_derivatives(const ResidualsOfPose& residuals,
                                                             const Pose& pose);

/// Where the sum of squares has its minimum: Gauss–Newton from a start close to it, with numeric
/// derivatives; a step that does not get lower is halved.
Pose plain_minimum(const ResidualsOfPose& residuals, const Pose& start);

}  // namespace vantage::test
