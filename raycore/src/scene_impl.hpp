#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "embree.hpp"

namespace vantage::detail {

/// Owns Embree's device and scenes. Geometry ids of the top scene are ObjectIds, for instances too.
struct SceneImpl {
  RTCDevice device = nullptr;
  RTCScene top = nullptr;
  std::vector<RTCScene> shared;                  ///< one per mesh that is instanced
  std::vector<Eigen::Matrix3f> normal_to_world;  ///< one per object; identity but for instances
  std::size_t triangle_count = 0;
  bool has_instances = false;

  SceneImpl();
  ~SceneImpl();
  SceneImpl(const SceneImpl&) = delete;
  SceneImpl& operator=(const SceneImpl&) = delete;

  /// @throws Error if Embree reported a failure since the last call.
  void check() const;

  /// Debian 12's Embree with AVX-512 can hang in rtcOccluded16 on coherent packets that meet
  /// instances, so those go as incoherent.
  bool use_coherent(bool wanted) const { return wanted && !has_instances; }
};

}  // namespace vantage::detail
