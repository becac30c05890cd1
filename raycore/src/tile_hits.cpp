// First hits of tiles of pixels: a camera and the tiles' places in, depths and objects out. Leaner
// than closest_hits, which reads directions from memory and writes normals to it.

#include <fmt/format.h>

#include <limits>

#include "batch.hpp"
#include "packet.hpp"
#include "pixel_direction.hpp"
#include "scene_impl.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/multiversion.hpp"
#include "vantage/raycore/scene.hpp"

namespace vantage {
namespace detail {
namespace {

// "GCC unroll 1" before the loops over a packet's lanes: unrolled before the vectoriser comes to
// see them, they would stay scalar, and cost as much as a traversal.

constexpr int kSide = PixelTile::kSide;
static_assert(PixelTile::kPixels == int(kPacketWidth));

/// The directions of a tile's pixels, as PinholeCamera::pixel_ray has them.
[[gnu::always_inline]] inline void fill_directions(const Intrinsics& k, const PixelRotation& R,
                                                   PixelTile tile, RTCRay16& rays) {
  double across[kSide], down[kSide];
#pragma GCC unroll 1
  for (int i = 0; i < kSide; ++i) {
    across[i] = (kSide * tile.column + i - k.cx) / k.fx;
    down[i] = (kSide * tile.row + i - k.cy) / k.fy;
  }
  double x[kPacketWidth], y[kPacketWidth];
  for (int row = 0; row < kSide; ++row) {
    for (int i = 0; i < kSide; ++i) x[kSide * row + i] = across[i];
    for (int i = 0; i < kSide; ++i) y[kSide * row + i] = down[row];
  }
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) rays.dir_x[i] = float(R.turned<0>(x[i], y[i]));
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) rays.dir_y[i] = float(R.turned<1>(x[i], y[i]));
#pragma GCC unroll 1
  for (std::size_t i = 0; i < kPacketWidth; ++i) rays.dir_z[i] = float(R.turned<2>(x[i], y[i]));
}

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

/// Whether Embree may see the rays of all tiles. Directions are linear in the pixel, so that those
/// of the outermost tiles decide for all.
bool valid_tiles(const PinholeCamera& camera) {
  constexpr int kFarthestPixel = kSide * (1 << 16);
  const Eigen::Vector3f o = camera.centre().cast<float>();
  bool ok = true;
  for (const int u : {0, kFarthestPixel}) {
    for (const int v : {0, kFarthestPixel}) {
      const Eigen::Vector3f d = camera.pixel_ray(u, v).direction.cast<float>();
      ok &= valid_ray(o.x(), o.y(), o.z(), d.x(), d.y(), d.z());
    }
  }
  return ok;
}

}  // namespace
}  // namespace detail

void Scene::first_hits(const PinholeCamera& camera, std::span<const PixelTile> tiles,
                       std::span<TileHits> hits) const {
  detail::check_batch_size("the array of hits", hits.size(), tiles.size());
  if (!detail::valid_tiles(camera)) {
    throw bad_input("camera",
                    fmt::format("its centre is [{}, {}, {}], its focal lengths {} and {} pixels; "
                                "expected coordinates and directions within 1e9 m of the origin",
                                camera.centre().x(), camera.centre().y(), camera.centre().z(),
                                camera.intrinsics().fx, camera.intrinsics().fy));
  }
  const detail::PacketJob job{impl_->top, impl_->use_coherent(true), float(camera.range().far_m)};
  detail::trace_tiles(job, camera.intrinsics(),
                      detail::PixelRotation(camera.T_world_cam().rotation()),
                      camera.centre().cast<float>(), tiles.data(), tiles.size(), hits.data());
}

}  // namespace vantage
