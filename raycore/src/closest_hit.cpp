// Closest hits, and the depth image that follows from them.

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "batch.hpp"
#include "multiversion.hpp"
#include "packet.hpp"
#include "pixel_order.hpp"
#include "scene_impl.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/scene.hpp"

namespace vantage {

void Hits::resize(std::size_t size) {
  t.resize(size), u.resize(size), v.resize(size);
  object.resize(size), triangle.resize(size);
  normal.resize(size);
}

namespace detail {
namespace {

struct RayLanes {
  const float *org_x, *org_y, *org_z;
  const float *dir_x, *dir_y, *dir_z;
};

template <std::size_t kOriginStride>
[[gnu::always_inline]] inline bool fill(const PacketJob& job, const RayLanes& r, std::size_t first,
                                        std::size_t count, RTCRayHit16& packet, int* valid) {
  int refused = 0;
  for (std::size_t lane = 0; lane < kPacketWidth; ++lane) {
    const std::size_t i = first + std::min(lane, count - 1);
    const float ox = r.org_x[i * kOriginStride];
    const float oy = r.org_y[i * kOriginStride];
    const float oz = r.org_z[i * kOriginStride];
    const float dx = r.dir_x[i], dy = r.dir_y[i], dz = r.dir_z[i];
    RTCRay16& rays = packet.ray;
    rays.org_x[lane] = ox, rays.org_y[lane] = oy, rays.org_z[lane] = oz;
    rays.dir_x[lane] = dx, rays.dir_y[lane] = dy, rays.dir_z[lane] = dz;
    rays.tfar[lane] = job.t_far;
    packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    const int ok = valid_ray(ox, oy, oz, dx, dy, dz);
    refused |= 1 - ok;
    valid[lane] = -(ok & int(lane < count));
  }
  return refused == 0;
}

struct HitLanes {
  float *t, *u, *v;
  ObjectId* object;
  std::uint32_t* triangle;
  float *normal_x, *normal_y, *normal_z;

  explicit HitLanes(Hits& h)
      : t(h.t.data()),
        u(h.u.data()),
        v(h.v.data()),
        object(h.object.data()),
        triangle(h.triangle.data()),
        normal_x(h.normal.x.data()),
        normal_y(h.normal.y.data()),
        normal_z(h.normal.z.data()) {}
};

[[gnu::always_inline]] inline void store(const RTCRayHit16& packet, std::size_t first,
                                         std::size_t count, const HitLanes& out) {
  for (std::size_t lane = 0; lane < count; ++lane) {
    const bool hit = packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
    const bool instance = packet.hit.instID[0][lane] != RTC_INVALID_GEOMETRY_ID;
    const std::size_t i = first + lane;
    const float nx = packet.hit.Ng_x[lane], ny = packet.hit.Ng_y[lane], nz = packet.hit.Ng_z[lane];
    const float scale = hit ? 1 / std::sqrt(nx * nx + ny * ny + nz * nz) : 0;
    out.t[i] = hit ? packet.ray.tfar[lane] : std::numeric_limits<float>::infinity();
    out.u[i] = hit ? packet.hit.u[lane] : 0;
    out.v[i] = hit ? packet.hit.v[lane] : 0;
    out.object[i] = instance ? packet.hit.instID[0][lane] : packet.hit.geomID[lane];
    out.triangle[i] = hit ? packet.hit.primID[lane] : 0;
    out.normal_x[i] = hit ? nx * scale : 0;
    out.normal_y[i] = hit ? ny * scale : 0;
    out.normal_z[i] = hit ? nz * scale : 0;
  }
}

template <std::size_t kOriginStride>
[[gnu::always_inline]] inline bool trace(const PacketJob& job, const RayLanes& rays,
                                         std::size_t first, std::size_t last, const HitLanes& out) {
  QueryContext context(job.coherent);
  alignas(64) RTCRayHit16 packet{};
  alignas(64) int valid[kPacketWidth];
  prepare(packet.ray, job);
  bool ok = true;
  for (std::size_t i = first; i < last; i += kPacketWidth) {
    const std::size_t count = std::min(kPacketWidth, last - i);
    ok &= fill<kOriginStride>(job, rays, i, count, packet, valid);
    context.intersect16(valid, job.scene, &packet);
    store(packet, i, count, out);
  }
  return ok;
}

VANTAGE_MULTIVERSION
bool trace_rays(const PacketJob& job, const RayLanes& rays, std::size_t first, std::size_t last,
                const HitLanes& out) {
  return trace<1>(job, rays, first, last, out);
}

VANTAGE_MULTIVERSION
bool trace_from_point(const PacketJob& job, const RayLanes& rays, std::size_t first,
                      std::size_t last, const HitLanes& out) {
  return trace<0>(job, rays, first, last, out);
}

/// Embree gives an instance's normal in the instance's frame.
void turn_instance_normals(const SceneImpl& scene, Hits& hits) {
  if (!scene.has_instances) return;
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits.hit(i)) {
      hits.normal.set(i, scene.normal_to_world[hits.object[i]] * hits.normal[i]);
    }
  }
}

void closest_hits_batch(const SceneImpl& scene, const PointLanes& origins, PointsView directions,
                        float t_near, float t_far, bool coherent, Hits& hits) {
  hits.resize(directions.size);
  const PacketJob job{scene.top, scene.use_coherent(coherent), t_near, t_far};
  const RayLanes lanes{origins.view.x, origins.view.y, origins.view.z,
                       directions.x,   directions.y,   directions.z};
  const HitLanes out(hits);
  const auto kernel = origins.stride == 0 ? trace_from_point : trace_rays;
  const bool ok = for_each_block(directions.size, [&](std::size_t first, std::size_t last) {
    return kernel(job, lanes, first, last, out);
  });
  if (!ok) refuse_first_ray(origins, directions);
  turn_instance_normals(scene, hits);
}

}  // namespace
}  // namespace detail

void Scene::closest_hits(PointsView origins, PointsView directions, Hits& hits,
                         RayOrder order) const {
  detail::check_batch_size("the array of origins", origins.size, directions.size);
  detail::closest_hits_batch(*impl_, detail::PointLanes(origins), directions, 0,
                             std::numeric_limits<float>::infinity(), order == RayOrder::coherent,
                             hits);
}

void Scene::closest_hits(const Eigen::Vector3f& origin, PointsView directions, Hits& hits,
                         RayOrder order) const {
  detail::closest_hits_batch(*impl_, detail::PointLanes(origin, directions.size), directions, 0,
                             std::numeric_limits<float>::infinity(), order == RayOrder::coherent,
                             hits);
}

std::optional<Hit> Scene::closest_hit(const Ray& ray) const {
  const Eigen::Vector3f &o = ray.origin, &d = ray.direction;
  if (!detail::valid_ray(o.x(), o.y(), o.z(), d.x(), d.y(), d.z())) {
    detail::refuse_first_ray(detail::PointLanes(o, 1), {&d.x(), &d.y(), &d.z(), 1});
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
  query.ray.mask = detail::kAllMasks;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  detail::QueryContext(false).intersect1(impl_->top, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;

  const bool instance = query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID;
  const ObjectId object = instance ? query.hit.instID[0] : query.hit.geomID;
  const Eigen::Vector3f normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
  return Hit{query.ray.tfar, object,      query.hit.primID,
             query.hit.u,    query.hit.v, impl_->normal_to_world[object] * normal.normalized()};
}

DepthImage Scene::render_depth(const PinholeCamera& camera) const {
  const Intrinsics& k = camera.intrinsics();
  DepthImage depth(k.width, k.height);
  const Eigen::Vector3f origin = camera.centre().cast<float>();
  const std::size_t bands = detail::band_count(k.height);
  tbb::parallel_for(std::size_t(0), bands, [&](std::size_t band) {
    const std::vector<detail::Pixel> pixels = detail::pixels_of_band(k, int(band));
    Points directions(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      directions.set(i, camera.pixel_ray(pixels[i].u, pixels[i].v).direction.cast<float>());
    }
    Hits hits;  // t is the depth: that is how pixel rays are scaled
    detail::closest_hits_batch(*impl_, detail::PointLanes(origin, pixels.size()), directions,
                               float(camera.range().near_m), float(camera.range().far_m), true,
                               hits);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (hits.hit(i)) depth.set(pixels[i].u, pixels[i].v, hits.t[i]);
    }
  });
  return depth;
}

Scene::Scene(std::unique_ptr<detail::SceneImpl> impl) : impl_(std::move(impl)) {}
Scene::~Scene() = default;
std::size_t Scene::object_count() const noexcept {
  return impl_->normal_to_world.size();
}
std::size_t Scene::triangle_count() const noexcept {
  return impl_->triangle_count;
}

}  // namespace vantage
