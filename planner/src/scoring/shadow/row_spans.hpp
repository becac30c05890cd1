#pragma once

#include <cstdint>

#include "scoring/shadow/masked_rasterizer.hpp"

// Which pixels lie between a polygon's edges, for all rows of a block of a ViewCover at once.

namespace vantage::detail {

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

}  // namespace vantage::detail
