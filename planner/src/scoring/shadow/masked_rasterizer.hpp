// Which pixels lie between a polygon's edges, for all rows of a block of a ViewCover at once.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "scoring/shadow/depth_weight.hpp"
#include "scoring/shadow/face_polygon.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage::planner::detail {

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

/// One element for each row of a block: a vector register, or a few.
template <class T>
struct alignas(64) RowLanes {
  T at[CoverBlock::kRows];
};

/// A loop over the rows of a block. Unless told not to, the compiler unrolls it before it comes to
/// vectorise it.
#define VANTAGE_EACH_ROW(i) _Pragma("GCC unroll 1") for (int i = 0; i < CoverBlock::kRows; ++i)

/// Pixels begin ≤ u < end of each row.
struct RowSpans {
  RowLanes<std::int32_t> begin, end;
};

/// The columns between a polygon's edges, rounded to the pixels within.
template <float PolygonEdge::*kOffset>
[[gnu::always_inline]] inline void find_spans(const FacePolygon& p, PixelSpan rows, int first_row,
                                              RowSpans& spans) {
  RowLanes<float> low, high;
  VANTAGE_EACH_ROW(i) {
    low.at[i] = float(p.columns.first);
    high.at[i] = float(p.columns.last);
  }
  for (int e = 0; e < p.left_edges; ++e) {
    const float slope = p.left[e].slope, offset = p.left[e].*kOffset;
    VANTAGE_EACH_ROW(i) {
      const float u = slope * float(first_row + i) + offset;
      low.at[i] = u > low.at[i] ? u : low.at[i];
    }
  }
  for (int e = 0; e < p.right_edges; ++e) {
    const float slope = p.right[e].slope, offset = p.right[e].*kOffset;
    VANTAGE_EACH_ROW(i) {
      const float u = slope * float(first_row + i) + offset;
      high.at[i] = u < high.at[i] ? u : high.at[i];
    }
  }
  const float beyond = float(p.columns.last + 1);
  VANTAGE_EACH_ROW(i) {
    low.at[i] = low.at[i] < beyond ? low.at[i] : beyond;
    high.at[i] = high.at[i] > -1.0f ? high.at[i] : -1.0f;
  }
  VANTAGE_EACH_ROW(i) {
    const float l = low.at[i], h = high.at[i];
    const std::int32_t whole_l = std::int32_t(l), whole_h = std::int32_t(h);
    const std::int32_t in_rows = (first_row + i >= rows.first) & (first_row + i <= rows.last);
    spans.begin.at[i] = whole_l + std::int32_t(float(whole_l) < l);
    spans.end.at[i] = (whole_h + 1 - std::int32_t(float(whole_h) > h)) * in_rows;
  }
}

[[gnu::always_inline]] inline std::int32_t within_block(std::int32_t column, std::int32_t first) {
  const std::int32_t c = column - first;
  const std::int32_t positive = c > 0 ? c : 0;
  return positive < CoverBlock::kColumns ? positive : CoverBlock::kColumns;
}

/// The bits begin … end - 1, for numbers from 0 to 32.
[[gnu::always_inline]] inline std::uint32_t span_bits(std::int32_t begin, std::int32_t end) {
  const std::uint32_t up_to_end = 0xFFFFFFFFu >> ((CoverBlock::kColumns - end) & 31);
  const std::uint32_t from_begin = 0xFFFFFFFFu << (begin & 31);
  return up_to_end & from_begin & (0u - std::uint32_t(begin < end));
}

/// std::popcount, in a form that is vectorised everywhere.
[[gnu::always_inline]] inline float bit_count(std::uint32_t x) {
  x -= (x >> 1) & 0x55555555u;
  x = (x & 0x33333333u) + ((x >> 2) & 0x33333333u);
  x = (x + (x >> 4)) & 0x0F0F0F0Fu;
  x += x >> 8;
  return float(std::int32_t((x + (x >> 16)) & 63u));
}

}  // namespace vantage::planner::detail
