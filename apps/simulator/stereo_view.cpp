#include "simulator/stereo_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vantage/raycore/multiversion.hpp"

namespace vantage::detail {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
using Numbers = StereoView::Numbers;

/// Pixels of a chunk, tile by tile, and the directions of their rays, scaled so that t is the
/// depth.
VANTAGE_MULTIVERSION
void make_rays(const Numbers& n, float first_u, float first_v, float* __restrict u,
               float* __restrict v, float* __restrict x, float* __restrict y, float* __restrict z) {
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

struct RayArrays {
  const float *u, *v, *dx, *dy, *dz, *t, *nx, *ny, *nz;
};

/// Depths of what is in range, inside the borders and not too slanted, NaN for the rest; and the
/// points from which the other devices are looked for: off the surface by a little, on its front.
VANTAGE_MULTIVERSION
void judge_hits(const Numbers& n, const RayArrays& r, float* __restrict depth, float* __restrict x,
                float* __restrict y, float* __restrict z) {
  for (std::size_t i = 0; i < kChunkRays; ++i) {
    const float t = r.t[i], dx = r.dx[i], dy = r.dy[i], dz = r.dz[i];
    const float along = r.nx[i] * dx + r.ny[i] * dy + r.nz[i] * dz;
    const float cosine_squared = along * along / (dx * dx + dy * dy + dz * dz);
    const bool found = (t >= n.near_m) & (t <= n.far_m) & (r.u[i] >= n.first_u) &
                       (r.u[i] <= n.last_u) & (r.v[i] >= n.first_v) & (r.v[i] <= n.last_v) &
                       (r.u[i] - n.shift_m_px / t >= n.first_u) &
                       (cosine_squared >= n.least_cosine_squared);
    depth[i] = found ? t : kNaN;
    // What is not found gets any point that a ray may start in.
    const float reach = t <= n.far_m ? t : n.far_m;
    const float off = (along > 0 ? -1e-4f : 1e-4f) * (reach > 0.1f ? reach : 0.1f);
    x[i] = n.centre.x() + reach * dx + off * r.nx[i];
    y[i] = n.centre.y() + reach * dy + off * r.ny[i];
    z[i] = n.centre.z() + reach * dz + off * r.nz[i];
  }
}

VANTAGE_MULTIVERSION
void remove_blocked(const std::uint8_t* __restrict blocked, float* __restrict depth) {
  for (std::size_t i = 0; i < kChunkRays; ++i) depth[i] = blocked[i] ? kNaN : depth[i];
}

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
          .least_cosine_squared = limited ? float(cosine * cosine) : -1.0f};
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

void StereoView::hide_from(const Eigen::Vector3f& origin, Scratch& s) const {
  scene_.occluded(s.from, origin, s.blocked, RayOrder::coherent);
  remove_blocked(s.blocked.data(), s.depth.data());
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
  const auto any = [&] {
    return std::any_of(s.depth.begin(), s.depth.end(), [](float z) { return z == z; });
  };
  if (second_imager_ && any()) hide_from(second_centre_, s);
  if (projector_ && any()) hide_from(projector_centre_, s);

  const int rows = std::min(kBandRows, height_ - first_v);
  const int columns = std::min(4 * kChunkTiles, width_ - first_u);
  for (int row = 0; row < rows; ++row) {
    float* out = metres + std::size_t(first_v + row) * std::size_t(width_) + first_u;
    for (int column = 0; column < columns; ++column) {
      out[column] = s.depth[std::size_t(column / 4 * 16 + row * 4 + column % 4)];
    }
  }
}

}  // namespace vantage::detail
