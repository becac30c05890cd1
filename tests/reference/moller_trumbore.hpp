#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::test {

/// Closer than this to an edge or an end point, float and double may disagree, metres.
inline constexpr double kCloseCall = 1e-5;

/// Where a line meets a triangle's plane, and how far it is from the triangle's border.
struct Crossing {
  double t;
  double margin_m;         ///< how far inside the triangle the line passes; negative outside
  double cosine;           ///< between the line and the triangle's normal, 0 to 1
  Eigen::Vector3d normal;  ///< unit length, by the right-hand rule
};

struct WorldTriangle {
  Eigen::Vector3d corners[3];
  ObjectId object;
  std::uint32_t index;

  Crossing cross(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const;
  double distance_to_plane(const Eigen::Vector3d& point) const;
};

/// The answer to a ray. `close_call`: within the margin it might as well be another one.
struct Verdict {
  bool hit = false;
  bool close_call = false;
  double t = 0;  ///< of the closest hit
};

/// The slow, obvious twin of Scene: Möller and Trumbore's test in double precision, every ray
/// against every triangle. Instead of their barycentric coordinates it looks at the line's
/// distances to the edges, which have the same signs and say how close a call it was.
class ReferenceScene {
 public:
  void add(const TriangleMesh& mesh, const Pose& T_world_mesh, ObjectId object);

  Verdict closest_hit(const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
                      double t_near, double t_far) const;

  /// Of the closed segment.
  Verdict occluded(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const;

  const std::vector<WorldTriangle>& triangles() const { return triangles_; }

  /// @returns null if there is none.
  const WorldTriangle* find(ObjectId object, std::uint32_t index) const;

 private:
  std::vector<WorldTriangle> triangles_;
};

}  // namespace vantage::test
