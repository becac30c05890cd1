#include "reference/plain_shadow.hpp"

#include <algorithm>
#include <cmath>

namespace vantage::test {
namespace {

constexpr double kOne = 0x1p35;
constexpr double kBeside = 0.01;  // pixels

/// A pixel's share of the score, before it is rounded; nothing if it does not count.
std::optional<double> weight(const PinholeCamera& view, double power, float t) {
  if (!(t >= float(view.range().near_m) && t <= float(view.range().far_m))) return std::nullopt;
  const double part = std::min(double(t) * (1 / view.range().far_m), 1.0);
  double product = 1;
  for (int i = 0; i < int(power); ++i) product *= part;
  return (power == std::floor(power) ? product : std::pow(part, power)) * kOne;
}

std::optional<double> weight_at(const Scene& surfaces, ObjectId shadow, const PinholeCamera& view,
                                double power, double u, double v) {
  const PixelRay ray = view.pixel_ray(u, v);
  const auto hit = surfaces.closest_hit({ray.origin.cast<float>(), ray.direction.cast<float>()});
  if (!hit || hit->object != shadow) return std::nullopt;
  return weight(view, power, hit->t);
}

void add(PlainShadow& sum, int u, int v, double pixel_weight) {
  ++sum.pixels;
  sum.score += std::uint64_t(std::nearbyint(pixel_weight));
  const auto b = sum.bounds.value_or(std::array{u, u, v, v});
  sum.bounds = {std::min(b[0], u), std::max(b[1], u), std::min(b[2], v), std::max(b[3], v)};
}

}  // namespace

PlainShadow plain_shadow(const Scene& surfaces, ObjectId shadow, const PinholeCamera& view,
                         double power) {
  PlainShadow sum;
  for (int v = 0; v < view.intrinsics().height; ++v) {
    for (int u = 0; u < view.intrinsics().width; ++u) {
      const auto here = weight_at(surfaces, shadow, view, power, u, v);
      if (here) add(sum, u, v, *here);
      double off = 1;  // the rounding to whole steps
      bool close_call = false;
      for (const auto& [du, dv] : {std::pair{-1, -1}, {-1, 1}, {1, -1}, {1, 1}}) {
        const auto beside =
            weight_at(surfaces, shadow, view, power, u + du * kBeside, v + dv * kBeside);
        close_call |= here.has_value() != beside.has_value();
        off = std::max(off, std::abs(here.value_or(0) - beside.value_or(0)));
      }
      sum.close_calls += close_call;
      sum.tolerance += off;
    }
  }
  return sum;
}

PlainShadow packet_shadow(const Scene& surfaces, ObjectId shadow, const PinholeCamera& view,
                          double power) {
  PlainShadow sum;
  for (int v = 0; v < view.intrinsics().height; v += 4) {
    for (int u = 0; u < view.intrinsics().width; u += 4) {
      const PixelTile tile{std::uint16_t(u / 4), std::uint16_t(v / 4)};
      TileHits hits;
      surfaces.first_hits(view, {&tile, 1}, {&hits, 1});
      for (int i = 0; i < 16; ++i) {
        const int pixel_u = u + i % 4, pixel_v = v + i / 4;
        if (pixel_u >= view.intrinsics().width || pixel_v >= view.intrinsics().height) continue;
        if (hits.object[i] != shadow) continue;
        if (const auto w = weight(view, power, hits.t[i])) add(sum, pixel_u, pixel_v, *w);
      }
    }
  }
  return sum;
}

}  // namespace vantage::test
