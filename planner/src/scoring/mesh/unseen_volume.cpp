#include "scoring/mesh/unseen_volume.hpp"

#include <bit>

#include "scoring/shadow/depth_weight.hpp"
#include "vantage/raycore/multiversion.hpp"

namespace vantage::detail {
namespace {

/// What the kernel needs of a view.
struct ViewLimits {
  int width, height;
  double near_m, far_m;
};

[[gnu::always_inline]] inline Score volume_of_body(const ViewLimits& view, const MeshTiles& tiles) {
  constexpr double kIntegers = 0x1p52;  // where a double's last bit counts 1
  const double per_far = 1 / view.far_m;
  Score sum = 0;
  for (std::size_t tile = 0; tile < tiles.tiles.size(); ++tile) {
    const PixelTile at = tiles.tiles[tile];
    const UnseenHits& unseen = tiles.unseen[tile];
    const TileHits& known = tiles.known[tile];
// "GCC unroll 1" as in depth_weight.cpp: so that the loop becomes vectors.
#pragma GCC unroll 1
    for (int i = 0; i < PixelTile::kPixels; ++i) {
      const int u = PixelTile::kSide * at.column + i % PixelTile::kSide,
                v = PixelTile::kSide * at.row + i / PixelTile::kSide;
      const float its_end = unseen.end[i], object = known.t[i];
      const double met = double(unseen.t[i]), ends = double(object < its_end ? object : its_end);
      const double begin = met < view.near_m ? view.near_m : met;
      const double end = ends < view.far_m ? ends : view.far_m;
      const bool counts = (u < view.width) & (v < view.height) & (begin < end);
      const double d = counts ? begin * per_far : 0, e = counts ? end * per_far : 0;
      const double weight = (1 - double(unseen.facing[i])) * (e * e * e - d * d * d);
      sum += std::bit_cast<Score>(weight * DepthWeight::kOne + kIntegers) -
             std::bit_cast<Score>(kIntegers);
    }
  }
  return sum;
}
constexpr Multiversion<volume_of_body> volume_of;

}  // namespace

Score unseen_volume(const PinholeCamera& view, const MeshTiles& tiles) {
  const Intrinsics& k = view.intrinsics();
  return volume_of({k.width, k.height, view.range().near_m, view.range().far_m}, tiles);
}

}  // namespace vantage::detail
