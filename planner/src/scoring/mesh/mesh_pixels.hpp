#pragma once

#include <cstdint>
#include <span>

#include "vantage/planner/view_scorer.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/advanced/unobserved_space.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage::planner::detail {

/// Some tiles of an image, and what their pixels meet first: unseen space, and known objects.
struct MeshTiles {
  std::span<const PixelTile> tiles;
  std::span<const UnseenHits> unseen;
  std::span<const TileHits> known;
};

/// Which pixels count for the mesh method, and how much. Pixels show unseen space if they lie on
/// the image, and meet it in range and before any known object.
class MeshPixels {
 public:
  MeshPixels(const Intrinsics& image, const DepthRange& range, double power);

  /// (1 - v) (D / far)^power of the pixels that show unseen space, each in steps of 2^-35.
  Score sum(const MeshTiles& tiles) const;

  /// No pixel counts more, if nothing unseen is farther than `farthest_m`.
  Score most(double farthest_m) const;

  /// One bit for each pixel of tile `i`: whether it shows unseen space with v up to `max_facing`.
  std::uint16_t shown(const MeshTiles& tiles, std::size_t i, float max_facing) const;

 private:
  int width_, height_;
  float near_m_, far_m_;
  double power_;
  int whole_power_;  ///< -1 for powers that are not
};

/// What the pixels of a view may show of the volume behind the unseen surfaces that they meet: of
/// each pixel on the image (1 - v) (E³ - D³) / far³, in steps of 2^-35. D is where its ray meets
/// unseen space, or near; E is where that ends (`UnseenHits::end`), a known object is, or far.
/// A pixel of one step of depth spans D² dD / (fx fy), so that a sum is a volume times 3 fx fy.
///
/// What the ray passes between D and E and a camera saw through counts, too: it is what the view
/// reveals at most. A pixel counts no more than (E / far)³.
Score unseen_volume(const PinholeCamera& view, const MeshTiles& tiles);

}  // namespace vantage::planner::detail
