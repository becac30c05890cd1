#pragma once

#include "vantage/reconstruction/object_type.hpp"

namespace vantage::reconstruction::detail {

/// `pose` turned around the type's axes of symmetry so that its rotation is as close to that of
/// `target` as it can be. Both T_x_object. Types without such axes: `pose` itself.
Pose turned_towards(const ObjectType& type, const Pose& pose, const Pose& target);

/// The same for one axis.
Pose turned_towards(const ContinuousSymmetry& symmetry, const Pose& pose, const Pose& target);

/// Along which (t, r) of T_world_object, as Matrix6d has it, the symmetry turns an object.
Eigen::Matrix<double, 6, 1> turn_direction(const ContinuousSymmetry& symmetry,
                                           const Pose& T_world_object);

/// Whether two poses show the same: by a symmetry of the type, within half a millimetre and five
/// milliradians.
bool equivalent(const ObjectType& type, const Pose& a, const Pose& b);

}  // namespace vantage::reconstruction::detail
