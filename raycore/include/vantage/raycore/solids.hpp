#pragma once

#include <Eigen/Core>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage {

/// Closed solids by formula: watertight, faces outwards, metres; z is up when the object stands as
/// it usually does, and the origin is the centre of the bounding box, as BOP has it for its models.
/// @throws Error bad_input, with `size_m` or the like as the place, for sizes that are not positive
/// and finite or that do not go together, and for those that floats cannot hold apart.
/// `segments` are even, from 4 to 4096: an odd number would leave the bounding box off the axis.

VANTAGE_API TriangleMesh box_solid(const Eigen::Vector3d& size_m);

/// Around z, with `segments` corners on its circles.
VANTAGE_API TriangleMesh cylinder_solid(double radius_m, double height_m, int segments = 48);

/// `segments` meridians and half as many latitudes; every corner lies on the sphere.
VANTAGE_API TriangleMesh sphere_solid(double radius_m, int segments = 64);

/// A box cut along the diagonal of its x-z side: a ramp that rises along x.
VANTAGE_API TriangleMesh wedge_solid(const Eigen::Vector3d& size_m);

/// Around z, open at the top: an outer and an inner wall and a bottom of `wall_m` thickness.
VANTAGE_API TriangleMesh cup_solid(double radius_m, double height_m, double wall_m,
                                   int segments = 48);

/// An L-shaped profile along y: a floor plate, and a back plate at its lower end of x, both of
/// `thickness_m`.
VANTAGE_API TriangleMesh bracket_solid(const Eigen::Vector3d& size_m, double thickness_m);

/// A box without a lid: four walls and a bottom of `wall_m` thickness inside `size_m`.
VANTAGE_API TriangleMesh bin_solid(const Eigen::Vector3d& size_m, double wall_m);

/// A rubber duck of the given length along x, beak first: the smooth union of a few ellipsoids (a
/// signed-distance formula), triangulated; smooth and curved all over, flat underneath.
VANTAGE_API TriangleMesh duck_solid(double length_m);

}  // namespace vantage
