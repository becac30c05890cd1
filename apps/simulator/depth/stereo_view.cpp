#include "simulator/depth/stereo_view.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage::simulator::detail {
namespace {

using Numbers = StereoView::Numbers;

/// Pixels of a chunk, tile by tile, and the directions of their rays, scaled so that t is the
/// depth.
[[gnu::always_inline]] inline void make_rays_body(const Numbers& n, float first_u, float first_v,
                                                  float* __restrict u, float* __restrict v,
                                                  float* __restrict x, float* __restrict y,
                                                  float* __restrict z) {
  for (std::size_t i = 0; i < kChunkRays; ++i) {
    u[i] = first_u + float(int(i / 16 * 4 + i % 4));
    v[i] = first_v + float(int(i / 4 % 4));
  }
  for (std::size_t i = 0; i < kChunkRays; ++i) {
    x[i] = n.corner.x() + u[i] * n.across.x() + v[i] * n.down.x();
    y[i] = n.corner.y() + u[i] * n.across.y() + v[i] * n.down.y();
    z[i] = n.corner.z() + u[i] * n.across.z() + v[i] * n.down.z();
  }
}
constexpr Multiversion<make_rays_body> make_rays;

struct RayArrays {
  const float *u, *v, *dx, *dy, *dz, *t, *nx, *ny, *nz;
};

/// Depths of what is in range, inside the borders and not too slanted, NaN for the rest; and the
/// points from which the other devices are looked for: off the surface by a little, on its front.
[[gnu::always_inline]] inline void judge_hits_body(const Numbers& n, const RayArrays& r,
                                                   float* __restrict depth, float* __restrict x,
                                                   float* __restrict y, float* __restrict z) {
  for (std::size_t i = 0; i < kChunkRays; ++i) {
    const float t = r.t[i], dx = r.dx[i], dy = r.dy[i], dz = r.dz[i];
    const float along = r.nx[i] * dx + r.ny[i] * dy + r.nz[i] * dz;
    const float cosine_squared = along * along / (dx * dx + dy * dy + dz * dz);
    const bool found = (t >= n.near_m) & (t <= n.far_m) & (r.u[i] >= n.first_u) &
                       (r.u[i] <= n.last_u) & (r.v[i] >= n.first_v) & (r.v[i] <= n.last_v) &
                       (r.u[i] - n.shift_m_px / t >= n.first_u) &
                       (cosine_squared >= n.min_cosine_squared);
    depth[i] = found ? t : DepthImage::kUnknown;
    // What is not found gets any point that a ray may start in.
    const float reach = t <= n.far_m ? t : n.far_m;
    const float off = (along > 0 ? -1e-4f : 1e-4f) * (reach > 0.1f ? reach : 0.1f);
    x[i] = n.centre.x() + reach * dx + off * r.nx[i];
    y[i] = n.centre.y() + reach * dy + off * r.ny[i];
    z[i] = n.centre.z() + reach * dz + off * r.nz[i];
  }
}
constexpr Multiversion<judge_hits_body> judge_hits;

/// Moves the points of those tiles where anything is found to the front.
/// @returns how many tiles these are; `tiles` gets their numbers.
[[gnu::always_inline]] inline std::size_t keep_found_tiles_body(const float* __restrict depth,
                                                                float* __restrict x,
                                                                float* __restrict y,
                                                                float* __restrict z,
                                                                std::uint8_t* __restrict tiles) {
  std::size_t kept = 0;
  for (std::size_t tile = 0; tile < kChunkTiles; ++tile) {
    int found = 0;
    for (std::size_t i = 16 * tile; i < 16 * tile + 16; ++i) found |= int(depth[i] == depth[i]);
    if (found == 0) continue;
    if (kept != tile) {
      for (float* p : {x, y, z}) std::copy_n(p + 16 * tile, 16, p + 16 * kept);
    }
    tiles[kept++] = std::uint8_t(tile);
  }
  return kept;
}
constexpr Multiversion<keep_found_tiles_body> keep_found_tiles;

[[gnu::always_inline]] inline void remove_blocked_body(const std::uint8_t* __restrict blocked,
                                                       const std::uint8_t* __restrict tiles,
                                                       std::size_t count, float* __restrict depth) {
  for (std::size_t k = 0; k < count; ++k) {
    float* z = depth + 16 * tiles[k];
    for (std::size_t i = 0; i < 16; ++i) z[i] = blocked[16 * k + i] ? DepthImage::kUnknown : z[i];
  }
}
constexpr Multiversion<remove_blocked_body> remove_blocked;

Numbers numbers_of(const PinholeCamera& camera, const StereoSensor& sensor) {
  const Intrinsics& k = camera.intrinsics();
  const Eigen::Matrix3d& r = camera.T_world_cam().rotation();
  const double cosine = std::cos(sensor.max_incidence_rad);
  const bool limited = cosine > 1e-9;
  const float border = float(sensor.border_px);
  return {.centre = camera.centre().cast<float>(),
          .across = (r.col(0) / k.fx).cast<float>(),
          .down = (r.col(1) / k.fy).cast<float>(),
          .corner = (r * Eigen::Vector3d(-k.cx / k.fx, -k.cy / k.fy, 1)).cast<float>(),
          .near_m = float(camera.range().near_m),
          .far_m = float(camera.range().far_m),
          .shift_m_px = sensor.second_imager ? float(k.fx * sensor.noise.baseline_m) : 0.0f,
          .first_u = border,
          .last_u = float(k.width - 1) - border,
          .first_v = border,
          .last_v = float(k.height - 1) - border,
          .min_cosine_squared = limited ? float(cosine * cosine) : -1.0f};
}

}  // namespace

StereoView::StereoView(const Scene& scene, const PinholeCamera& camera, const StereoSensor& sensor)
    : scene_(scene),
      width_(camera.intrinsics().width),
      height_(camera.intrinsics().height),
      numbers_(numbers_of(camera, sensor)),
      second_imager_(sensor.second_imager),
      projector_(sensor.projector) {
  const Eigen::Vector3d x = camera.T_world_cam().rotation().col(0);
  second_centre_ = (camera.centre() + sensor.noise.baseline_m * x).cast<float>();
  projector_centre_ = (camera.centre() + sensor.projector_m * x).cast<float>();
}

void StereoView::fill_band(int band, Scratch& scratch, float* metres) const {
  for (int u = 0; u < width_; u += 4 * kChunkTiles) {
    fill_chunk(u, band * kBandRows, scratch, metres);
  }
}

void StereoView::hide_from(const Eigen::Vector3f& origin, std::size_t tiles, Scratch& s) const {
  scene_.occluded(s.from.view().part(0, 16 * tiles), origin, {s.blocked.data(), 16 * tiles},
                  RayOrder::coherent);
  remove_blocked(s.blocked.data(), s.tiles.data(), tiles, s.depth.data());
}

void StereoView::fill_chunk(int first_u, int first_v, Scratch& s, float* metres) const {
  Points &d = s.directions, &from = s.from;
  make_rays(numbers_, float(first_u), float(first_v), s.u.data(), s.v.data(), d.x.data(),
            d.y.data(), d.z.data());
  scene_.closest_hits(numbers_.centre, d, s.hits);
  const Points& normal = s.hits.normal;
  judge_hits(numbers_,
             {s.u.data(), s.v.data(), d.x.data(), d.y.data(), d.z.data(), s.hits.t.data(),
              normal.x.data(), normal.y.data(), normal.z.data()},
             s.depth.data(), from.x.data(), from.y.data(), from.z.data());
  const std::size_t tiles =
      keep_found_tiles(s.depth.data(), from.x.data(), from.y.data(), from.z.data(), s.tiles.data());
  if (second_imager_) hide_from(second_centre_, tiles, s);
  if (projector_) hide_from(projector_centre_, tiles, s);
  lay_out(first_u, first_v, s.depth.data(), metres);
}

/// Tile by tile → row by row.
void StereoView::lay_out(int first_u, int first_v, const float* depth, float* metres) const {
  const int rows = std::min(kBandRows, height_ - first_v);
  const int columns = std::min(4 * kChunkTiles, width_ - first_u);
  for (int row = 0; row < rows; ++row) {
    float* out = metres + std::size_t(first_v + row) * std::size_t(width_) + first_u;
    const float* in = depth + 4 * row;
    for (int column = 0; column < columns; column += 4, in += 16) {
      std::copy_n(in, std::min(4, columns - column), out + column);
    }
  }
}

}  // namespace vantage::simulator::detail
