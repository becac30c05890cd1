#include "scene/pixel_tile.hpp"

#include <fmt/format.h>

#include <cmath>

#include "vantage/raycore/error.hpp"

namespace vantage::raycore::detail {
namespace {

constexpr int kFarthestPixel = PixelTile::kSide * (1 << 16);

/// Whether a few comparisons tell that Embree may see the rays of all tiles: no coordinate of a
/// direction is above 1.3e6 / 0.01 · √2 + 1. True of every camera that is one.
bool surely_valid_tiles(const PinholeCamera& camera) {
  const Intrinsics& k = camera.intrinsics();
  static_assert(kFarthestPixel < 3e5);
  const Eigen::Vector3f o = camera.centre().cast<float>();
  return k.fx >= 0.01 && k.fy >= 0.01 && std::abs(k.cx) <= 1e6 && std::abs(k.cy) <= 1e6 &&
         in_reach(o.x(), o.y(), o.z());
}

/// Whether Embree may see the rays of all tiles. Directions are linear in the pixel, so that those
/// of the outermost tiles decide for all.
bool valid_tiles(const PinholeCamera& camera) {
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

void check_tiles(const PinholeCamera& camera) {
  if (surely_valid_tiles(camera) || valid_tiles(camera)) return;
  throw bad_input("camera",
                  fmt::format("its centre is [{}, {}, {}], its focal lengths {} and {} pixels; "
                              "expected coordinates and directions within 1e9 m of the origin",
                              camera.centre().x(), camera.centre().y(), camera.centre().z(),
                              camera.intrinsics().fx, camera.intrinsics().fy));
}

}  // namespace vantage::raycore::detail
