#pragma once

#include <vector>

#include "vantage/raycore/pose.hpp"
#include "vantage/reconstruction/object_type.hpp"
#include "voting/vote_table.hpp"

namespace vantage::reconstruction::detail {

/// Where a vote for this pose falls. Of a type with an axis of symmetry, only where the axis is and
/// where it points counts; of one with several, only their crossing.
VotePlace place_of(const ObjectType& type, std::uint32_t rank, const Pose& T_world_object);

/// Poses that stand for one that is only known with this covariance: itself, or three along each of
/// up to two axes along which its standard deviation is above half a cell, up to 1.2 standard
/// deviations to both sides (of at most two cells), equally likely.
/// @returns 1, 3 or 9 poses.
std::vector<Pose> spread(const Pose& pose, const Matrix6d& covariance, const VoteGrid& grid);

/// The squared Mahalanobis distance of two independent estimates of one pose.
double squared_distance(const Pose& a, const Matrix6d& covariance_a, const Pose& b,
                        const Matrix6d& covariance_b);

}  // namespace vantage::reconstruction::detail
