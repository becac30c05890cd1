#pragma once

#include <Eigen/Core>

#include "reference/moller_trumbore.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::test {

/// The distance of a point from the segment from `a` to `b`.
double segment_distance(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                        const Eigen::Vector3d& b);

/// The least distance of two triangles, 0 where they cross.
double triangle_distance(const WorldTriangle& a, const WorldTriangle& b);

/// The least distance of two surfaces in double precision, 0 where they cross: every triangle of
/// the one against every triangle of the other, points on edges found by bisection.
double surface_distance(const TriangleMesh& a, const Pose& T_world_a, const TriangleMesh& b,
                        const Pose& T_world_b);

/// Whether a closed mesh surrounds the point: its triangles' signed solid angles sum to 4π, not 0.
bool surrounds(const TriangleMesh& mesh, const Pose& T_world_mesh, const Eigen::Vector3d& point);

}  // namespace vantage::test
