#pragma once

#include <vector>

#include "reference/random_workcell.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage::test {

inline const Intrinsics kSmallImage{64, 48, 70, 70, 31.5, 23.5};

/// Views from one place: some at the work area's middle, others past it, some away from it; of
/// cameras that see far, and of some whose depth range ends within the work area.
inline std::vector<PinholeCamera> random_shared_views(Random& random, std::size_t count) {
  Eigen::Vector3d direction = random.direction();
  direction.z() = std::abs(direction.z());
  const Eigen::Vector3d middle(0, 0, 0.1);
  const Eigen::Vector3d eye = middle + random.uniform(0.25, 0.6) * direction;
  const double far_m = random.below(3) == 0 ? random.uniform(0.2, 0.5) : 2;
  std::vector<PinholeCamera> views;
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d target = middle + random.in_cube(i % 4 == 0 ? 1e-6 : 0.3);
    views.emplace_back(kSmallImage, Pose::looking_at(eye, target), DepthRange{0.1, far_m});
  }
  return views;
}

}  // namespace vantage::test
