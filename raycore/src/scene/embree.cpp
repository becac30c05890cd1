#include "scene/embree.hpp"

#include <fmt/format.h>

#include "vantage/raycore/detail/instruction_set.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::raycore::detail {

EmbreeDevice::EmbreeDevice()
    : device_(rtcNewDevice(fmt::format("max_isa={}", name_of(instruction_set())).c_str())) {
  if (device_ != nullptr) return;
  throw Error(ErrorCode::out_of_resources, "scene", "Embree cannot be started on this machine");
}

EmbreeDevice::~EmbreeDevice() {
  rtcReleaseDevice(device_);
}

void EmbreeDevice::check() const {
  const RTCError error = rtcGetDeviceError(device_);
  if (error == RTC_ERROR_NONE) return;
  throw Error(ErrorCode::out_of_resources, "scene",
              error == RTC_ERROR_OUT_OF_MEMORY
                  ? "there is not enough memory for the BVH; use a coarser mesh or larger voxels"
                  : fmt::format("Embree failed with error {}", int(error)));
}

void commit_scene(const EmbreeDevice& device, RTCScene scene) {
  rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  rtcCommitScene(scene);
  device.check();
}

}  // namespace vantage::raycore::detail
