// First hits of tiles of pixels: a camera and the tiles' places in, depths and objects out. Leaner
// than closest_hits, which reads directions from memory and writes normals to it.

#include <limits>

#include "batch.hpp"
#include "packet.hpp"
#include "scene_impl.hpp"
#include "tile_rays.hpp"
#include "vantage/raycore/multiversion.hpp"
#include "vantage/raycore/scene.hpp"

namespace vantage {
namespace detail {
namespace {

[[gnu::always_inline]] inline void store(const RTCRayHit16& packet, TileHits& hits) {
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const unsigned geometry = packet.hit.geomID[i], instance = packet.hit.instID[0][i];
    const float t = packet.ray.tfar[i];
    const bool is_hit = geometry != RTC_INVALID_GEOMETRY_ID;
    hits.t[i] = is_hit ? t : std::numeric_limits<float>::infinity();
    hits.object[i] = instance != RTC_INVALID_GEOMETRY_ID ? instance : geometry;
  }
}

VANTAGE_MULTIVERSION
void trace_tiles(const PacketJob& job, const Intrinsics& k, const PixelRotation& R,
                 const Eigen::Vector3f& origin, const PixelTile* tiles, std::size_t count,
                 TileHits* hits) {
  QueryContext context(job.coherent);
  alignas(64) RTCRayHit16 packet{};
  alignas(64) int valid[kPacketWidth];
  prepare(packet.ray);
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    packet.ray.org_x[i] = origin.x();
    packet.ray.org_y[i] = origin.y();
    packet.ray.org_z[i] = origin.z();
    valid[i] = -1;
  }
  for (std::size_t tile = 0; tile < count; ++tile) {
    fill_directions(k, R, tiles[tile], packet.ray);
#pragma GCC unroll 1
    for (std::size_t i = 0; i < kPacketWidth; ++i) {
      packet.ray.tfar[i] = job.t_far;
      packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
      packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    }
    context.intersect16(valid, job.scene, &packet);
    store(packet, hits[tile]);
  }
}

}  // namespace
}  // namespace detail

void Scene::first_hits(const PinholeCamera& camera, std::span<const PixelTile> tiles,
                       std::span<TileHits> hits) const {
  detail::check_batch_size("the array of hits", hits.size(), tiles.size());
  detail::check_tiles(camera);
  const detail::PacketJob job{impl_->top, impl_->use_coherent(true), float(camera.range().far_m)};
  detail::trace_tiles(job, camera.intrinsics(),
                      detail::PixelRotation(camera.T_world_cam().rotation()),
                      camera.centre().cast<float>(), tiles.data(), tiles.size(), hits.data());
}

}  // namespace vantage
