#pragma once

#include <memory>
#include <type_traits>

#include "scene/embree.hpp"

namespace vantage::detail {

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

}  // namespace vantage::detail
