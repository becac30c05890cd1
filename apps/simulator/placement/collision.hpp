#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <vector>

#include "simulator/placement/triangle_distance.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage {

using EdgeEnds = std::array<Eigen::Vector3d, 2>;

/// What `closer_than` needs of a mesh, in the mesh's frame. Immutable; bodies of one mesh share it.
class CollisionShape {
 public:
  /// Builds a BVH.
  explicit CollisionShape(const TriangleMesh& mesh);

  /// The corners of its triangles, each once.
  const std::vector<Eigen::Vector3d>& points() const noexcept { return points_; }
  const Eigen::AlignedBox3d& bounds() const noexcept { return bounds_; }

  const std::vector<EdgeEnds>& edges() const noexcept { return edges_; }  ///< each once
  const std::vector<TriangleCorners>& triangles() const noexcept { return triangles_; }
  const Scene& rays() const noexcept { return *rays_; }

 private:
  std::vector<Eigen::Vector3d> points_;
  Eigen::AlignedBox3d bounds_;
  std::vector<EdgeEnds> edges_;
  std::vector<TriangleCorners> triangles_;
  std::shared_ptr<const Scene> rays_;
};

/// Whether two closed bodies cross, lie within each other, or come closer to each other than
/// `gap_m`. Rays, which are floats, look for crossings; distances in double for what is near.
/// Whatever rays miss by rounding is that near, as long as the gap is 1e-6 of the bodies' size or
/// more. May be called from many threads at once.
bool closer_than(double gap_m, const CollisionShape& a, const Pose& T_world_a,
                 const CollisionShape& b, const Pose& T_world_b);

}  // namespace vantage
