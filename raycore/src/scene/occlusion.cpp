// Occlusion of point pairs: the query that classification and scoring spend their time in.

#include <algorithm>

#include "scene/batch.hpp"
#include "scene/packet.hpp"
#include "scene/scene_impl.hpp"
#include "vantage/raycore/multiversion.hpp"
#include "vantage/raycore/scene.hpp"

namespace vantage {
namespace detail {
namespace {

struct SegmentLanes {
  const float *from_x, *from_y, *from_z;
  const float *to_x, *to_y, *to_z;
};

// kToStride 0: all segments end in one point. kFull: a whole packet, whose loops have a constant
// length. Both decide at compile time what would otherwise cost as much as a short traversal.
template <std::size_t kToStride, bool kFull>
[[gnu::always_inline]] inline bool fill(const SegmentLanes& s, std::size_t first, std::size_t count,
                                        RTCRay16& rays, int* valid) {
  int refused = 0;
  for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
    const std::size_t i = first + (kFull ? lane : std::min(lane, count - 1));
    const float ox = s.from_x[i], oy = s.from_y[i], oz = s.from_z[i];
    const float tx = s.to_x[i * kToStride];
    const float ty = s.to_y[i * kToStride];
    const float tz = s.to_z[i * kToStride];
    const int ok = valid_segment(ox, oy, oz, tx, ty, tz);
    set_ray(rays, lane, ok, ox, oy, oz, tx - ox, ty - oy, tz - oz);
    rays.tfar[lane] = kSegmentEnd;
    refused |= 1 - ok;
    valid[lane] = kFull ? -ok : -(ok & int(lane < count));
  }
  return refused == 0;
}

template <std::size_t kToStride>
[[gnu::always_inline]] inline bool trace(const PacketJob& job, const SegmentLanes& s,
                                         std::size_t first, std::size_t last,
                                         std::uint8_t* result) {
  QueryContext context(job.coherent);
  alignas(64) RTCRay16 rays;
  alignas(64) int valid[kPacketWidth];
  prepare(rays);
  bool ok = true;
  std::size_t i = first;
  for (; i + kPacketWidth <= last; i += kPacketWidth) {
    ok &= fill<kToStride, true>(s, i, kPacketWidth, rays, valid);
    context.occluded16(valid, job.scene, &rays);
    for (std::size_t lane = 0; lane < kPacketWidth; ++lane) result[i + lane] = rays.tfar[lane] < 0;
  }
  if (i < last) {
    ok &= fill<kToStride, false>(s, i, last - i, rays, valid);
    context.occluded16(valid, job.scene, &rays);
    for (std::size_t lane = 0; i + lane < last; ++lane) result[i + lane] = rays.tfar[lane] < 0;
  }
  return ok;
}

[[gnu::always_inline]] inline bool trace_pairs_body(const PacketJob& job, const SegmentLanes& s,
                                                    std::size_t first, std::size_t last,
                                                    std::uint8_t* result) {
  return trace<1>(job, s, first, last, result);
}
constexpr Multiversion<trace_pairs_body> trace_pairs;

[[gnu::always_inline]] inline bool trace_to_point_body(const PacketJob& job, const SegmentLanes& s,
                                                       std::size_t first, std::size_t last,
                                                       std::uint8_t* result) {
  return trace<0>(job, s, first, last, result);
}
constexpr Multiversion<trace_to_point_body> trace_to_point;

void occluded_batch(const SceneImpl& scene, PointsView from, const PointLanes& to,
                    std::span<std::uint8_t> result, RayOrder order) {
  const PacketJob job{scene.top, scene.use_coherent(order == RayOrder::coherent), kSegmentEnd};
  const SegmentLanes lanes{from.x, from.y, from.z, to.view.x, to.view.y, to.view.z};
  const auto kernel = to.stride == 0 ? trace_to_point : trace_pairs;
  const bool ok = for_each_block(from.size, [&](std::size_t first, std::size_t last) {
    return kernel(job, lanes, first, last, result.data());
  });
  if (!ok) refuse_first_segment(from, to);
}

}  // namespace
}  // namespace detail

bool Scene::occluded(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const {
  if (!detail::valid_segment(from.x(), from.y(), from.z(), to.x(), to.y(), to.z())) {
    detail::refuse_first_segment({&from.x(), &from.y(), &from.z(), 1}, detail::PointLanes(to, 1));
  }
  const Eigen::Vector3f direction = to - from;
  RTCRay ray{};
  ray.org_x = from.x(), ray.org_y = from.y(), ray.org_z = from.z();
  ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
  ray.tfar = detail::kSegmentEnd;
  ray.mask = detail::kAllMasks;
  detail::QueryContext(false).occluded1(impl_->top, &ray);
  return ray.tfar < 0;
}

void Scene::occluded(PointsView from, PointsView to, std::span<std::uint8_t> result,
                     RayOrder order) const {
  detail::check_batch_size("the array of end points", to.size, from.size);
  detail::check_batch_size("the result", result.size(), from.size);
  detail::occluded_batch(*impl_, from, detail::PointLanes(to), result, order);
}

void Scene::occluded(PointsView from, const Eigen::Vector3f& to, std::span<std::uint8_t> result,
                     RayOrder order) const {
  detail::check_batch_size("the result", result.size(), from.size);
  detail::occluded_batch(*impl_, from, detail::PointLanes(to, from.size), result, order);
}

}  // namespace vantage
