#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/embree.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "workload.hpp"

namespace vantage::bench {

/// The same triangles as a Scene has, built with Embree alone.
class BareScene {
 public:
  explicit BareScene(const std::vector<TriangleMesh>& meshes,
                     RTCSceneFlags flags = RTC_SCENE_FLAG_ROBUST);
  ~BareScene();
  BareScene(const BareScene&) = delete;
  BareScene& operator=(const BareScene&) = delete;

  RTCScene get() const { return scene_; }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

/// A workload's rays in the form that Embree takes. Whoever calls Embree directly must fill these
/// too; here that is done beforehand and not measured. What Embree overwrites is put back before
/// each call, and each answer is written out.
class BareRays {
 public:
  explicit BareRays(const Workload& work);

  void occluded1(const BareScene& scene, std::uint8_t* result);
  void occluded16(const BareScene& scene, std::uint8_t* result, bool coherent);
  void intersect1(const BareScene& scene, Hits& hits);
  void intersect16(const BareScene& scene, Hits& hits, bool coherent);

 private:
  std::size_t size_;
  std::vector<RTCRay> rays_;
  std::vector<RTCRay16> packets_;
  std::vector<RTCRayHit> hit_rays_;
  std::vector<RTCRayHit16> hit_packets_;
};

}  // namespace vantage::bench
