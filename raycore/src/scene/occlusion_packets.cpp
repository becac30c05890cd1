// Occlusion packet by packet, answers as bits: for callers who decide after a few packets which
// ones they still need.

#include <stdexcept>

#include "scene/batch.hpp"
#include "scene/packet.hpp"
#include "scene/scene_impl.hpp"
#include "vantage/raycore/multiversion.hpp"
#include "vantage/raycore/scene.hpp"

namespace vantage {
namespace detail {
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
}  // namespace detail

void Scene::occluded(PointsView from, const Eigen::Vector3f& to,
                     std::span<const std::uint32_t> packets, std::span<const std::uint16_t> wanted,
                     std::span<std::uint16_t> hidden) const {
  detail::check_packets(from.size, packets, {wanted.size(), hidden.size()});
  const detail::PacketQuery query{impl_->top, from,           to.x(),        to.y(),
                                  to.z(),     packets.data(), wanted.data(), packets.size()};
  if (!detail::trace_packets(query, hidden.data())) detail::refuse_first_wanted(query);
}

}  // namespace vantage
