// First hits of tiles of pixels: a camera and the tiles' places in, depths and objects out. Leaner
// than closest_hits, which reads directions from memory and writes normals to it.

#include <algorithm>
#include <limits>

#include "scene/batch.hpp"
#include "scene/packet.hpp"
#include "scene/scene_impl.hpp"
#include "scene/tile_rays.hpp"
#include "vantage/raycore/multiversion.hpp"
#include "vantage/raycore/scene.hpp"

namespace vantage {
namespace detail {
namespace {

constexpr int kSide = PixelTile::kSide;

[[gnu::always_inline]] inline void load_tile(const TileRays& rays, float t_far,
                                             RTCRayHit16& packet) {
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) packet.ray.dir_x[i] = rays.x[i];
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) packet.ray.dir_y[i] = rays.y[i];
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) packet.ray.dir_z[i] = rays.z[i];
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    packet.ray.tfar[i] = t_far;
    packet.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
}

[[gnu::always_inline]] inline void store_tile(const RTCRayHit16& packet, TileHits& hits) {
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const unsigned geometry = packet.hit.geomID[i], instance = packet.hit.instID[0][i];
    const float t = packet.ray.tfar[i];
    const bool is_hit = geometry != RTC_INVALID_GEOMETRY_ID;
    hits.t[i] = is_hit ? t : std::numeric_limits<float>::infinity();
    hits.object[i] = instance != RTC_INVALID_GEOMETRY_ID ? instance : geometry;
  }
}

[[gnu::always_inline]] inline void trace_tiles_body(const PacketJob& job, const Intrinsics& k,
                                                    const PixelRotation& R,
                                                    const Eigen::Vector3f& origin,
                                                    const PixelTile* tiles, std::size_t count,
                                                    TileHits* hits) {
  QueryContext context(job.coherent);
  alignas(64) RTCRayHit16 packet{};
  alignas(64) int valid[kPacketWidth];
  TileRays rays[kTilesAhead];
  TilePlaces places;
  prepare(packet.ray);
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    packet.ray.org_x[i] = origin.x();
    packet.ray.org_y[i] = origin.y();
    packet.ray.org_z[i] = origin.z();
    valid[i] = -1;
  }
  for (std::size_t first = 0; first < count; first += kTilesAhead) {
    const std::size_t last = std::min(first + kTilesAhead, count);
    places.set(k, tiles + first, int(last - first));
    for (std::size_t tile = first; tile < last; ++tile) {
      const double* x = places.x + kSide * (tile - first);
      const double* y = places.y + kSide * (tile - first);
      fill_axis<0>(R, x, y, rays[tile - first].x);
      fill_axis<1>(R, x, y, rays[tile - first].y);
      fill_axis<2>(R, x, y, rays[tile - first].z);
    }
    for (std::size_t tile = first; tile < last; ++tile) {
      load_tile(rays[tile - first], job.t_far, packet);
      context.intersect16(valid, job.scene, &packet);
      store_tile(packet, hits[tile]);
    }
  }
}
constexpr Multiversion<trace_tiles_body> trace_tiles;

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
