#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scoring/shadow/depth_weight.hpp"
#include "scoring/shadow/face_polygon.hpp"
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
  std::uint16_t possible(PixelTile tile) const {
    const std::uint32_t* rows = rows_of(tile);
    const int shift = tile.column * PixelTile::kSide % CoverBlock::kColumns;
    const auto row = [&](int i) { return (rows[i] >> shift & 0xFu) << (PixelTile::kSide * i); };
    return std::uint16_t(row(0) | row(1) | row(2) | row(3));
  }

  /// Calls `visit(tile, pixels)` for those tiles of a row, from column `first` to `last`, that may
  /// show a face; `pixels` as of `possible`.
  template <class Visit>
  void for_each_in_row(int row, int first, int last, const Visit& visit) const {
    constexpr int kSide = PixelTile::kSide, kTiles = CoverBlock::kColumns / kSide;
    for (int column = first; column <= last;) {
      const int next = (column / kTiles + 1) * kTiles, end = next <= last ? next : last + 1;
      const std::uint32_t* rows = rows_of({std::uint16_t(column), std::uint16_t(row)});
      const bool any = (rows[0] | rows[1] | rows[2] | rows[3]) != 0;
      for (; any && column < end; ++column) {
        const PixelTile tile{std::uint16_t(column), std::uint16_t(row)};
        if (const std::uint16_t pixels = possible(tile); pixels != 0) visit(tile, pixels);
      }
      column = end;
    }
  }

  /// The tiles of a block that may show a face: at most 32.
  std::span<const PixelTile> tiles(std::size_t block, std::span<PixelTile, 32> room) const;

 private:
  /// The four rows of bits that a tile is in.
  const std::uint32_t* rows_of(PixelTile tile) const {
    constexpr int kSide = PixelTile::kSide;
    const int chunk = tile.column * kSide / CoverBlock::kColumns - first_chunk_,
              group = tile.row * kSide / CoverBlock::kRows - first_group_;
    return blocks_[std::size_t(group * chunks_ + chunk)].possible +
           tile.row * kSide % CoverBlock::kRows;
  }

  int first_chunk_, chunks_, first_group_;
  std::vector<CoverBlock> blocks_;  ///< row by row
};

}  // namespace vantage::detail
