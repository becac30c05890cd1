#pragma once

#include <Eigen/Core>

#include "reference/moller_trumbore.hpp"
#include "vantage/raycore/box.hpp"

namespace vantage::test {

/// The least distance of a scene's triangles from a point, every one of them looked at; of `object`
/// only, unless that is `kNoObject`. Infinite without triangles.
double nearest_surface(const ReferenceScene& scene, const Eigen::Vector3d& point,
                       ObjectId object = kNoObject);

/// The same for a solid box: 0 if a triangle touches it or lies inside it.
double nearest_surface(const ReferenceScene& scene, const Box& box, const Pose& T_world_box,
                       ObjectId object = kNoObject);

/// Whether an object's winding number at a point is not 0, from its triangles' solid angles.
bool surrounded(const ReferenceScene& scene, const Eigen::Vector3d& point);

}  // namespace vantage::test
