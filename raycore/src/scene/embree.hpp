#pragma once

#include <memory>
#include <type_traits>

// The only place that knows which Embree it is: Debian 12 has 3.13, Debian 13 has 4.3. They differ
// in the header's place, in how the flags of a query are passed, and in a geometry's default mask
// (all bits in 3, one bit in 4), which is why every geometry and every ray sets its own.
#if VANTAGE_EMBREE_MAJOR == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif

namespace vantage::raycore::detail {

inline constexpr unsigned kAllMasks = 0xFFFFFFFFu;

#if VANTAGE_EMBREE_MAJOR == 3

/// The flags of a query, in the form that this Embree wants.
class QueryContext {
 public:
  explicit QueryContext(bool coherent) {
    rtcInitIntersectContext(&context_);
    context_.flags =
        coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  void occluded1(RTCScene scene, RTCRay* ray) { rtcOccluded1(scene, &context_, ray); }
  void intersect1(RTCScene scene, RTCRayHit* ray) { rtcIntersect1(scene, &context_, ray); }
  void occluded16(const int* valid, RTCScene scene, RTCRay16* rays) {
    rtcOccluded16(valid, scene, &context_, rays);
  }
  void intersect16(const int* valid, RTCScene scene, RTCRayHit16* rays) {
    rtcIntersect16(valid, scene, &context_, rays);
  }

 private:
  RTCIntersectContext context_;
};

#else

class QueryContext {
 public:
  explicit QueryContext(bool coherent) {
    const RTCRayQueryFlags flags =
        coherent ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT;
    rtcInitOccludedArguments(&occluded_);
    rtcInitIntersectArguments(&intersect_);
    occluded_.flags = flags;
    intersect_.flags = flags;
  }
  void occluded1(RTCScene scene, RTCRay* ray) { rtcOccluded1(scene, ray, &occluded_); }
  void intersect1(RTCScene scene, RTCRayHit* ray) { rtcIntersect1(scene, ray, &intersect_); }
  void occluded16(const int* valid, RTCScene scene, RTCRay16* rays) {
    rtcOccluded16(valid, scene, rays, &occluded_);
  }
  void intersect16(const int* valid, RTCScene scene, RTCRayHit16* rays) {
    rtcIntersect16(valid, scene, rays, &intersect_);
  }

 private:
  RTCOccludedArguments occluded_;
  RTCIntersectArguments intersect_;
};

#endif

/// Embree's device: what its scenes and geometries are made with.
class EmbreeDevice {
 public:
  /// @throws Error out_of_resources
  EmbreeDevice();
  ~EmbreeDevice();
  EmbreeDevice(const EmbreeDevice&) = delete;
  EmbreeDevice& operator=(const EmbreeDevice&) = delete;

  operator RTCDevice() const { return device_; }

  /// @throws Error out_of_resources if Embree failed in this thread since the last call.
  void check() const;

 private:
  RTCDevice device_;
};

struct ReleaseScene {
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using OwnedScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

/// Commits a scene as all of ours are: robust, because otherwise rays slip through shared edges.
void commit_scene(const EmbreeDevice& device, RTCScene scene);

}  // namespace vantage::raycore::detail
