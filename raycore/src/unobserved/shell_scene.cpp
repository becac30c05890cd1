#include "unobserved/shell_scene.hpp"

#include <cstring>

namespace vantage::raycore::detail {

ShellScene::ShellScene(const EmbreeDevice& device, const TriangleMesh& shell)
    : scene_(rtcNewScene(device)) {
  if (!shell.triangles().empty()) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto fill = [&](RTCBufferType type, RTCFormat format, const auto& items) {
      const std::size_t size = sizeof(items[0]);
      void* to = rtcSetNewGeometryBuffer(geometry, type, 0, format, size, items.size());
      device.check();
      std::memcpy(to, items.data(), size * items.size());
    };
    fill(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, shell.vertices());
    fill(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, shell.triangles());
    rtcSetGeometryMask(geometry, kAllMasks);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
  }
  commit_scene(device, scene_.get());
}

}  // namespace vantage::raycore::detail
