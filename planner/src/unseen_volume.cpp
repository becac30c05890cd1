#include "unseen_volume.hpp"

#include <bit>
#include <limits>

#include "depth_weight.hpp"
#include "vantage/raycore/multiversion.hpp"

namespace vantage::detail {
namespace {

constexpr int kPixels = PixelTile::kPixels, kSide = PixelTile::kSide;

/// What the kernel needs, in plain arrays. The ray of pixel (u, v) is at
/// `centre + depth · (corner + u · right + v · down)`.
struct Rays {
  int width, height;
  double near_m, far_m;
  double centre[3], corner[3], right[3], down[3];
  double low[3], high[3];  ///< the work area
};

/// The depths at which the pixels' rays leave the work area.
[[gnu::always_inline]] inline void leave(const Rays& r, PixelTile tile, double* depth) {
  for (int axis = 0; axis < 3; ++axis) {
#pragma GCC unroll 1
    for (int i = 0; i < kPixels; ++i) {
      const double u = kSide * tile.column + i % kSide, v = kSide * tile.row + i / kSide;
      const double step = r.corner[axis] + u * r.right[axis] + v * r.down[axis];
      const double wall = (step > 0 ? r.high[axis] : r.low[axis]) - r.centre[axis];
      const double at = step == 0 ? std::numeric_limits<double>::infinity() : wall / step;
      depth[i] = at < depth[i] ? at : depth[i];
    }
  }
}

VANTAGE_MULTIVERSION
Score volume_of(const Rays& r, const MeshTiles& tiles) {
  constexpr double kIntegers = 0x1p52;  // where a double's last bit counts 1
  const double per_far = 1 / r.far_m;
  Score sum = 0;
  for (std::size_t tile = 0; tile < tiles.tiles.size(); ++tile) {
    const PixelTile at = tiles.tiles[tile];
    const UnseenHits& unseen = tiles.unseen[tile];
    alignas(64) double end[kPixels];
#pragma GCC unroll 1
    for (int i = 0; i < kPixels; ++i) {
      const double known = double(tiles.known[tile].t[i]);
      end[i] = known < r.far_m ? known : r.far_m;
    }
    leave(r, at, end);
#pragma GCC unroll 1
    for (int i = 0; i < kPixels; ++i) {
      const int u = kSide * at.column + i % kSide, v = kSide * at.row + i / kSide;
      const double met = double(unseen.t[i]);
      const double begin = met < r.near_m ? r.near_m : met;
      const bool counts = (u < r.width) & (v < r.height) & (begin < end[i]);
      const double d = counts ? begin * per_far : 0, e = counts ? end[i] * per_far : 0;
      const double weight = (1 - double(unseen.facing[i])) * (e * e * e - d * d * d);
      sum += std::bit_cast<Score>(weight * DepthWeight::kOne + kIntegers) -
             std::bit_cast<Score>(kIntegers);
    }
  }
  return sum;
}

}  // namespace

Score unseen_volume(const PinholeCamera& view, const Box& work_area, const MeshTiles& tiles) {
  const Intrinsics& k = view.intrinsics();
  const PixelRay first = view.pixel_ray(0, 0);
  const Eigen::Vector3d right = view.T_world_cam().rotation().col(0) / k.fx;
  const Eigen::Vector3d down = view.T_world_cam().rotation().col(1) / k.fy;
  Rays rays{};
  rays.width = k.width, rays.height = k.height;
  rays.near_m = view.range().near_m, rays.far_m = view.range().far_m;
  for (int axis = 0; axis < 3; ++axis) {
    rays.centre[axis] = first.origin[axis], rays.corner[axis] = first.direction[axis];
    rays.right[axis] = right[axis], rays.down[axis] = down[axis];
    rays.low[axis] = work_area.min()[axis], rays.high[axis] = work_area.max()[axis];
  }
  return volume_of(rays, tiles);
}

}  // namespace vantage::detail
