// Closest hits, in two ways: of any rays, with normals, directions being read from memory; and of
// tiles of a camera's pixels, with no more than depths and objects, which is leaner.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scene/batch.hpp"
#include "scene/pixel_tile.hpp"
#include "scene/ray_packet.hpp"
#include "scene/scene_impl.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/detail/multiversion.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {

void Hits::resize(std::size_t size) {
  t.resize(size), u.resize(size), v.resize(size);
  object.resize(size), triangle.resize(size);
  normal.resize(size);
}

namespace raycore::detail {
namespace {

template <std::size_t kOriginStride>
[[gnu::always_inline]] inline bool trace(const PacketJob& job, const RayLanes& rays,
                                         std::size_t first, std::size_t last, const HitLanes& out) {
  QueryContext context(job.coherent);
  alignas(64) RTCRayHit16 packet{};
  alignas(64) int valid[kPacketWidth];
  prepare(packet.ray);
  bool ok = true;
  std::size_t i = first;
  for (; i + kPacketWidth <= last; i += kPacketWidth) {
    ok &= fill<kOriginStride, true>(job, rays, i, kPacketWidth, packet, valid);
    context.intersect16(valid, job.scene, &packet);
    finish(packet);
    store(packet, i, kPacketWidth, out);
  }
  if (i < last) {
    ok &= fill<kOriginStride, false>(job, rays, i, last - i, packet, valid);
    context.intersect16(valid, job.scene, &packet);
    finish(packet);
    store(packet, i, last - i, out);
  }
  return ok;
}

[[gnu::always_inline]] inline bool trace_rays_body(const PacketJob& job, const RayLanes& rays,
                                                   std::size_t first, std::size_t last,
                                                   const HitLanes& out) {
  return trace<1>(job, rays, first, last, out);
}
constexpr Multiversion<trace_rays_body> trace_rays;

[[gnu::always_inline]] inline bool trace_from_point_body(const PacketJob& job, const RayLanes& rays,
                                                         std::size_t first, std::size_t last,
                                                         const HitLanes& out) {
  return trace<0>(job, rays, first, last, out);
}
constexpr Multiversion<trace_from_point_body> trace_from_point;

/// Embree gives an instance's normal in the instance's frame.
void turn_instance_normals(const SceneImpl& scene, std::size_t first, std::size_t last,
                           Hits& hits) {
  if (!scene.has_instances) return;
  for (std::size_t i = first; i < last; ++i) {
    if (hits.hit(i)) {
      hits.normal.set(i, scene.normal_to_world[hits.object[i]] * hits.normal[i]);
    }
  }
}

void closest_hits_batch(const SceneImpl& scene, const PointLanes& origins, PointsView directions,
                        float t_far, bool coherent, Hits& hits) {
  hits.resize(directions.size);
  const PacketJob job{scene.top, scene.use_coherent(coherent), t_far};
  const RayLanes lanes{origins.view.x, origins.view.y, origins.view.z,
                       directions.x,   directions.y,   directions.z};
  const HitLanes out(hits);
  const auto kernel = origins.stride == 0 ? trace_from_point : trace_rays;
  const bool ok = for_each_block(directions.size, [&](std::size_t first, std::size_t last) {
    const bool block_ok = kernel(job, lanes, first, last, out);
    turn_instance_normals(scene, first, last, hits);
    return block_ok;
  });
  if (!ok) refuse_first_ray(origins, directions);
}

}  // namespace
}  // namespace raycore::detail

void Scene::closest_hits(PointsView origins, PointsView directions, Hits& hits,
                         RayOrder order) const {
  raycore::detail::check_batch_size("the array of origins", origins.size, directions.size);
  raycore::detail::closest_hits_batch(*impl_, raycore::detail::PointLanes(origins), directions,
                                      std::numeric_limits<float>::infinity(),
                                      order == RayOrder::coherent, hits);
}

void Scene::closest_hits(const Eigen::Vector3f& origin, PointsView directions, Hits& hits,
                         RayOrder order) const {
  raycore::detail::closest_hits_batch(*impl_, raycore::detail::PointLanes(origin, directions.size),
                                      directions, std::numeric_limits<float>::infinity(),
                                      order == RayOrder::coherent, hits);
}

std::optional<Hit> Scene::closest_hit(const Ray& ray) const {
  const Eigen::Vector3f &o = ray.origin, &d = ray.direction;
  if (!raycore::detail::valid_ray(o.x(), o.y(), o.z(), d.x(), d.y(), d.z())) {
    raycore::detail::refuse_first_ray(raycore::detail::PointLanes(o, 1),
                                      {&d.x(), &d.y(), &d.z(), 1});
  }
  if (!(ray.t_near >= 0 && ray.t_near <= ray.t_far)) {
    throw bad_input("ray 0", fmt::format("t goes from {} to {}; expected 0 <= t_near <= t_far",
                                         ray.t_near, ray.t_far));
  }
  RTCRayHit query{};
  query.ray.org_x = o.x(), query.ray.org_y = o.y(), query.ray.org_z = o.z();
  query.ray.dir_x = d.x(), query.ray.dir_y = d.y(), query.ray.dir_z = d.z();
  query.ray.tnear = ray.t_near;
  query.ray.tfar = ray.t_far;
  query.ray.mask = raycore::detail::kAllMasks;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  raycore::detail::QueryContext(false).intersect1(impl_->top, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  const bool instance = query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
  const ObjectId object = instance ? query.hit.instID[0] : query.hit.geomID;
  const Eigen::Vector3f normal =
      Eigen::Vector3f(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z).stableNormalized();
  return Hit{query.ray.tfar, object,      query.hit.primID,
             query.hit.u,    query.hit.v, impl_->normal_to_world[object] * normal};
}

DepthImage Scene::render_depth(const PinholeCamera& camera) const {
  const Intrinsics& k = camera.intrinsics();
  DepthImage depth(k.width, k.height);
  const Eigen::Vector3f origin = camera.centre().cast<float>();
  if (!raycore::detail::in_reach(origin.x(), origin.y(), origin.z())) {
    throw bad_input("camera",
                    fmt::format("its centre is [{}, {}, {}]; expected coordinates within "
                                "1e9 m of the origin",
                                camera.centre().x(), camera.centre().y(), camera.centre().z()));
  }
  const float near_m = float(camera.range().near_m), far_m = float(camera.range().far_m);
  const std::size_t bands = raycore::detail::band_count(k.height);
  tbb::parallel_for(std::size_t(0), bands, [&](std::size_t band) {
    const std::vector<raycore::detail::Pixel> pixels =
        raycore::detail::pixels_of_band(k, int(band));
    Points directions(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      directions.set(i, camera.pixel_ray(pixels[i].u, pixels[i].v).direction.cast<float>());
    }
    // t is the depth: that is how pixel rays are scaled. Rays start at the camera, not at the near
    // depth: what stands too near hides what is behind it.
    Hits hits;
    raycore::detail::closest_hits_batch(*impl_, raycore::detail::PointLanes(origin, pixels.size()),
                                        directions, far_m, true, hits);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (hits.hit(i) && hits.t[i] >= near_m) depth.set(pixels[i].u, pixels[i].v, hits.t[i]);
    }
  });
  return depth;
}

Scene::Scene(std::unique_ptr<raycore::detail::SceneImpl> impl) : impl_(std::move(impl)) {}
Scene::~Scene() = default;
std::size_t Scene::object_count() const noexcept {
  return impl_->normal_to_world.size();
}
std::size_t Scene::triangle_count() const noexcept {
  return impl_->triangle_count;
}
std::size_t Scene::triangle_count(ObjectId object) const noexcept {
  return impl_->triangles[object].count;
}
std::array<Eigen::Vector3d, 3> Scene::corners(ObjectId object, std::size_t triangle) const {
  return impl_->triangles[object].corners(std::uint32_t(triangle));
}

namespace raycore::detail {
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
}  // namespace raycore::detail

void Scene::first_hits(const PinholeCamera& camera, std::span<const PixelTile> tiles,
                       std::span<TileHits> hits) const {
  raycore::detail::check_batch_size("the array of hits", hits.size(), tiles.size());
  raycore::detail::check_tiles(camera);
  const raycore::detail::PacketJob job{impl_->top, impl_->use_coherent(true),
                                       float(camera.range().far_m)};
  raycore::detail::trace_tiles(
      job, camera.intrinsics(), raycore::detail::PixelRotation(camera.T_world_cam().rotation()),
      camera.centre().cast<float>(), tiles.data(), tiles.size(), hits.data());
}

}  // namespace vantage
