// Occlusion of point pairs: the query that classification and scoring spend their time in.
// Occlusion packet by packet, answers as bits: for callers who decide after a few packets which
// ones they still need.
#include <algorithm>
#include <stdexcept>

#include "scene/batch.hpp"
#include "scene/ray_packet.hpp"
#include "scene/scene_impl.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage {
namespace raycore::detail {
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
}  // namespace raycore::detail

bool Scene::occluded(const Eigen::Vector3f& from, const Eigen::Vector3f& to) const {
  if (!raycore::detail::valid_segment(from.x(), from.y(), from.z(), to.x(), to.y(), to.z())) {
    raycore::detail::refuse_first_segment({&from.x(), &from.y(), &from.z(), 1},
                                          raycore::detail::PointLanes(to, 1));
  }
  const Eigen::Vector3f direction = to - from;
  RTCRay ray{};
  ray.org_x = from.x(), ray.org_y = from.y(), ray.org_z = from.z();
  ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
  ray.tfar = raycore::detail::kSegmentEnd;
  ray.mask = raycore::detail::kAllMasks;
  raycore::detail::QueryContext(false).occluded1(impl_->top, &ray);
  return ray.tfar < 0;
}

void Scene::occluded(PointsView from, PointsView to, std::span<std::uint8_t> result,
                     RayOrder order) const {
  raycore::detail::check_batch_size("the array of end points", to.size, from.size);
  raycore::detail::check_batch_size("the result", result.size(), from.size);
  raycore::detail::occluded_batch(*impl_, from, raycore::detail::PointLanes(to), result, order);
}

void Scene::occluded(PointsView from, const Eigen::Vector3f& to, std::span<std::uint8_t> result,
                     RayOrder order) const {
  raycore::detail::check_batch_size("the result", result.size(), from.size);
  raycore::detail::occluded_batch(*impl_, from, raycore::detail::PointLanes(to, from.size), result,
                                  order);
}

namespace raycore::detail {
namespace {

struct PacketQuery {
  RTCScene scene;
  PointsView from;
  float to_x, to_y, to_z;
  const std::uint32_t* packets;
  const std::uint16_t* wanted;
  std::size_t count;
};

/// @returns false if a ray that was wanted is none that Embree may see.
[[gnu::always_inline]] inline bool trace_packets_body(const PacketQuery& q, std::uint16_t* hidden) {
  QueryContext context(false);
  alignas(64) RTCRay16 rays;
  alignas(64) int valid[kPacketWidth];
  prepare(rays);
  int refused = 0;
  for (std::size_t i = 0; i < q.count; ++i) {
    const PointsView from = q.from.part(q.packets[i] * kPacketWidth, kPacketWidth);
    const int wanted = q.wanted[i];
    hidden[i] = 0;
    if (wanted == 0) continue;
    for (int lane = 0; lane < int(kPacketWidth); ++lane) {
      const float ox = from.x[lane], oy = from.y[lane], oz = from.z[lane];
      const int ok = valid_segment(ox, oy, oz, q.to_x, q.to_y, q.to_z);
      set_ray(rays, std::size_t(lane), ok, ox, oy, oz, q.to_x - ox, q.to_y - oy, q.to_z - oz);
      rays.tfar[lane] = kSegmentEnd;
      const int asked = (wanted >> lane) & 1;
      refused |= asked & ~ok;
      valid[lane] = -(ok & asked);
    }
    context.occluded16(valid, q.scene, &rays);
    std::uint8_t flags[kPacketWidth];
    for (std::size_t lane = 0; lane < kPacketWidth; ++lane) flags[lane] = rays.tfar[lane] < 0;
    hidden[i] = std::uint16_t(to_bits(flags) & wanted);
  }
  return refused == 0;
}
constexpr Multiversion<trace_packets_body> trace_packets;

[[noreturn]] void refuse_first_wanted(const PacketQuery& q) {
  const Eigen::Vector3f to(q.to_x, q.to_y, q.to_z);
  for (std::size_t i = 0; i < q.count; ++i) {
    for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
      const std::size_t point = q.packets[i] * kPacketWidth + lane;
      const Eigen::Vector3f from = q.from[point];
      const bool ok = valid_segment(from.x(), from.y(), from.z(), to.x(), to.y(), to.z());
      if (!ok && (q.wanted[i] >> lane & 1) != 0) refuse_segment(point, from, to);
    }
  }
  throw std::logic_error("no segment is invalid");
}

}  // namespace
}  // namespace raycore::detail

void Scene::occluded(PointsView from, const Eigen::Vector3f& to,
                     std::span<const std::uint32_t> packets, std::span<const std::uint16_t> wanted,
                     std::span<std::uint16_t> hidden) const {
  raycore::detail::check_packets(from.size, packets, {wanted.size(), hidden.size()});
  const raycore::detail::PacketQuery query{
      impl_->top, from, to.x(), to.y(), to.z(), packets.data(), wanted.data(), packets.size()};
  if (!raycore::detail::trace_packets(query, hidden.data()))
    raycore::detail::refuse_first_wanted(query);
}

}  // namespace vantage
