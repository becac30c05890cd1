#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "scene/embree.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::raycore::detail {

/// An object's triangles where Embree keeps them: they live as long as the scene.
struct ObjectTriangles {
  const Eigen::Vector3f* vertices = nullptr;
  const Triangle* triangles = nullptr;
  std::size_t count = 0;
  bool is_instance = false;
  Pose T_world_mesh = {};  ///< of an instance

  /// In the world frame.
  std::array<Eigen::Vector3d, 3> corners(std::uint32_t triangle) const {
    std::array<Eigen::Vector3d, 3> result;
    for (std::size_t i = 0; i < 3; ++i) {
      result[i] = vertices[triangles[triangle][i]].cast<double>();
      if (is_instance) result[i] = T_world_mesh * result[i];
    }
    return result;
  }
};

/// Owns Embree's device and scenes. Geometry ids of the top scene are ObjectIds, for instances too.
struct SceneImpl {
  EmbreeDevice device;
  RTCScene top;
  std::vector<RTCScene> shared;                  ///< one per mesh that is instanced
  std::vector<Eigen::Matrix3f> normal_to_world;  ///< one per object; identity but for instances
  std::vector<ObjectTriangles> triangles;        ///< one per object
  std::size_t triangle_count = 0;
  bool has_instances = false;

  SceneImpl();
  ~SceneImpl();
  SceneImpl(const SceneImpl&) = delete;
  SceneImpl& operator=(const SceneImpl&) = delete;

  /// Debian 12's Embree with AVX-512 can hang in rtcOccluded16 on coherent packets that meet
  /// instances, so those go as incoherent.
  bool use_coherent(bool wanted) const { return wanted && !has_instances; }
};

}  // namespace vantage::raycore::detail
