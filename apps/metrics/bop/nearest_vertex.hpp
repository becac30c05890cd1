#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace vantage {

/// Finds the nearest of many points with a k-d tree. Immutable; thread-safe.
class NearestVertex {
 public:
  /// One point at least.
  explicit NearestVertex(std::vector<Eigen::Vector3d> points);
  ~NearestVertex();

  /// From `point` to the nearest of the points.
  double distance_m(const Eigen::Vector3d& point) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

}  // namespace vantage
