#include "unseen_volume.hpp"

#include <bit>

#include "depth_weight.hpp"
#include "vantage/raycore/multiversion.hpp"

namespace vantage::detail {
namespace {

constexpr int kPixels = PixelTile::kPixels, kSide = PixelTile::kSide;

/// What the kernel needs of a view.
struct Image {
  int width, height;
  double near_m, far_m;
};

VANTAGE_MULTIVERSION
Score volume_of(const Image& image, const MeshTiles& tiles) {
  constexpr double kIntegers = 0x1p52;  // where a double's last bit counts 1
  const double per_far = 1 / image.far_m;
  Score sum = 0;
  for (std::size_t tile = 0; tile < tiles.tiles.size(); ++tile) {
    const PixelTile at = tiles.tiles[tile];
    const UnseenHits& unseen = tiles.unseen[tile];
    const TileHits& known = tiles.known[tile];
// "GCC unroll 1" as in depth_weight.cpp: so that the loop becomes vectors.
#pragma GCC unroll 1
    for (int i = 0; i < kPixels; ++i) {
      const int u = kSide * at.column + i % kSide, v = kSide * at.row + i / kSide;
      const float its_end = unseen.end[i], object = known.t[i];
      const double met = double(unseen.t[i]), ends = double(object < its_end ? object : its_end);
      const double begin = met < image.near_m ? image.near_m : met;
      const double end = ends < image.far_m ? ends : image.far_m;
      const bool counts = (u < image.width) & (v < image.height) & (begin < end);
      const double d = counts ? begin * per_far : 0, e = counts ? end * per_far : 0;
      const double weight = (1 - double(unseen.facing[i])) * (e * e * e - d * d * d);
      sum += std::bit_cast<Score>(weight * DepthWeight::kOne + kIntegers) -
             std::bit_cast<Score>(kIntegers);
    }
  }
  return sum;
}

}  // namespace

Score unseen_volume(const PinholeCamera& view, const MeshTiles& tiles) {
  const Intrinsics& k = view.intrinsics();
  return volume_of({k.width, k.height, view.range().near_m, view.range().far_m}, tiles);
}

}  // namespace vantage::detail
