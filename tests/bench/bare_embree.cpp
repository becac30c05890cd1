#include "bare_embree.hpp"

#include <algorithm>
#include <cstring>
#include <limits>

#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage::bench {
namespace {

constexpr std::size_t kWidth = 16;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

[[gnu::always_inline]] inline void trace_occluded16_body(RTCScene scene, bool coherent,
                                                         RTCRay16* packets, std::size_t size,
                                                         std::uint8_t* result) {
  raycore::detail::QueryContext context(coherent);
  alignas(64) int valid[kWidth];
  std::fill(valid, valid + kWidth, -1);
  for (std::size_t i = 0; i < size; i += kWidth, ++packets) {
    for (std::size_t lane = 0; lane < kWidth; ++lane) packets->tfar[lane] = 1;
    context.occluded16(valid, scene, packets);
    for (std::size_t lane = 0; lane < kWidth; ++lane) result[i + lane] = packets->tfar[lane] < 0;
  }
}
constexpr Multiversion<trace_occluded16_body> trace_occluded16;

[[gnu::always_inline]] inline void trace_intersect16_body(RTCScene scene, bool coherent,
                                                          RTCRayHit16* packets, Hits& hits) {
  raycore::detail::QueryContext context(coherent);
  alignas(64) int valid[kWidth];
  std::fill(valid, valid + kWidth, -1);
  const auto copy = [](auto& to, std::size_t i, const auto* from) {
    std::memcpy(&to[i], from, kWidth * sizeof(*from));
  };
  for (std::size_t i = 0; i < hits.size(); i += kWidth, ++packets) {
    for (std::size_t lane = 0; lane < kWidth; ++lane) {
      packets->ray.tfar[lane] = kInfinity;
      packets->hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      packets->hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    context.intersect16(valid, scene, packets);
    copy(hits.t, i, packets->ray.tfar);
    copy(hits.u, i, packets->hit.u);
    copy(hits.v, i, packets->hit.v);
    copy(hits.object, i, packets->hit.geomID);
    copy(hits.triangle, i, packets->hit.primID);
    copy(hits.normal.x, i, packets->hit.Ng_x);
    copy(hits.normal.y, i, packets->hit.Ng_y);
    copy(hits.normal.z, i, packets->hit.Ng_z);
  }
}
constexpr Multiversion<trace_intersect16_body> trace_intersect16;

RTCRay single(const Workload& work, std::size_t i) {
  RTCRay ray{};
  ray.org_x = work.origins.x[i], ray.org_y = work.origins.y[i], ray.org_z = work.origins.z[i];
  ray.dir_x = work.directions.x[i];
  ray.dir_y = work.directions.y[i];
  ray.dir_z = work.directions.z[i];
  ray.mask = raycore::detail::kAllMasks;
  return ray;
}

RTCRay16 packet(const Workload& work, std::size_t first) {
  RTCRay16 rays{};
  for (std::size_t lane = 0; lane < kWidth; ++lane) {
    const RTCRay ray = single(work, first + lane);
    rays.org_x[lane] = ray.org_x, rays.org_y[lane] = ray.org_y, rays.org_z[lane] = ray.org_z;
    rays.dir_x[lane] = ray.dir_x, rays.dir_y[lane] = ray.dir_y, rays.dir_z[lane] = ray.dir_z;
    rays.mask[lane] = ray.mask;
  }
  return rays;
}

}  // namespace

BareScene::BareScene(const std::vector<TriangleMesh>& meshes, RTCSceneFlags flags)
    : device_(rtcNewDevice(nullptr)), scene_(rtcNewScene(device_)) {
  for (const TriangleMesh& mesh : meshes) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const auto fill = [&](RTCBufferType type, RTCFormat format, const auto& items) {
      const std::size_t bytes = sizeof(items[0]);
      std::memcpy(rtcSetNewGeometryBuffer(geometry, type, 0, format, bytes, items.size()),
                  items.data(), items.size() * bytes);
    };
    fill(RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.vertices());
    fill(RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles());
    rtcSetGeometryMask(geometry, raycore::detail::kAllMasks);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
  }
  rtcSetSceneFlags(scene_, flags);
  rtcSetSceneBuildQuality(scene_, RTC_BUILD_QUALITY_MEDIUM);
  rtcCommitScene(scene_);
}

BareScene::~BareScene() {
  rtcReleaseScene(scene_);
  rtcReleaseDevice(device_);
}

BareRays::BareRays(const Workload& work) : size_(work.size()) {
  for (std::size_t i = 0; i < size_; ++i) {
    rays_.push_back(single(work, i));
    hit_rays_.push_back({rays_.back(), {}});
    if (i % kWidth != 0) continue;
    packets_.push_back(packet(work, i));
    hit_packets_.push_back({packets_.back(), {}});
  }
}

void BareRays::occluded1(const BareScene& scene, std::uint8_t* result) {
  raycore::detail::QueryContext context(false);
  for (std::size_t i = 0; i < size_; ++i) {
    rays_[i].tfar = 1;
    context.occluded1(scene.get(), &rays_[i]);
    result[i] = rays_[i].tfar < 0;
  }
}

void BareRays::occluded16(const BareScene& scene, std::uint8_t* result, bool coherent) {
  trace_occluded16(scene.get(), coherent, packets_.data(), size_, result);
}

void BareRays::intersect1(const BareScene& scene, Hits& hits) {
  raycore::detail::QueryContext context(false);
  for (std::size_t i = 0; i < size_; ++i) {
    RTCRayHit& query = hit_rays_[i];
    query.ray.tfar = kInfinity;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    context.intersect1(scene.get(), &query);
    hits.t[i] = query.ray.tfar, hits.u[i] = query.hit.u, hits.v[i] = query.hit.v;
    hits.object[i] = query.hit.geomID, hits.triangle[i] = query.hit.primID;
    hits.normal.set(i, {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z});
  }
}

void BareRays::intersect16(const BareScene& scene, Hits& hits, bool coherent) {
  trace_intersect16(scene.get(), coherent, hit_packets_.data(), hits);
}

}  // namespace vantage::bench
