#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "depth_weight.hpp"
#include "face_polygon.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/scene.hpp"

namespace vantage::detail {

/// A block of 32 × 16 pixels: for each row, bits for its pixels.
struct CoverBlock {
  static constexpr int kColumns = 32, kRows = 16;
  alignas(64) std::uint32_t possible[kRows];  ///< a ray may meet a face there
  alignas(64) std::uint32_t certain[kRows];   ///< it certainly does, at a depth that is counted
  alignas(64) float bound[kRows];             ///< of what the row's pixels count
};

/// Faces drawn on a view, conservatively: which pixels may show them, and what those count at most.
///
/// Faces are drawn in any order, best from front to back: pixels that a face covers for certain are
/// left out of those that come later, whose depth there cannot matter. What hides faces is drawn
/// after those that it does not hide.
class ViewCover {
 public:
  /// Nothing drawn yet; faces will lie within these columns and rows.
  ViewCover(PixelSpan columns, PixelSpan rows);

  void draw(const FacePolygon& polygon, const WeightBound& weight);

  /// Something that no ray passes, and that counts nothing.
  void draw_occluder(const FacePolygon& polygon);

  /// Without `certain` and `bound`.
  void draw_possible(const FacePolygon& polygon);

  std::size_t block_count() const { return blocks_.size(); }
  bool empty_block(std::size_t block) const;
  Score bound(std::size_t block) const;

  /// One bit for each pixel of a tile among the columns and rows: whether it may show a face.
  std::uint16_t possible(PixelTile tile) const;

  /// The tiles of a block that may show a face: at most 32.
  std::span<const PixelTile> tiles(std::size_t block, std::span<PixelTile, 32> room) const;

 private:
  int first_chunk_, chunks_, first_group_;
  std::vector<CoverBlock> blocks_;  ///< row by row
};

}  // namespace vantage::detail
