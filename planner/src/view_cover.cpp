#include "view_cover.hpp"

#include <algorithm>

#include "vantage/raycore/multiversion.hpp"

namespace vantage::detail {
namespace {

constexpr int kRows = CoverBlock::kRows, kColumns = CoverBlock::kColumns;

/// Pixels begin ≤ u < end of each row of a block row.
struct RowSpans {
  alignas(64) std::int32_t begin[kRows], end[kRows];
};

/// The rows' columns between the polygon's edges, rounded to the pixels within.
[[gnu::always_inline]] inline void find_spans(const FacePolygon& p, bool inner, PixelSpan rows,
                                              int first_row, RowSpans& spans) {
  alignas(64) float low[kRows], high[kRows];
  for (int i = 0; i < kRows; ++i) {
    low[i] = float(p.columns.first);
    high[i] = float(p.columns.last);
  }
  for (int e = 0; e < p.left_edges; ++e) {
    const float slope = p.left[e].slope, offset = inner ? p.left[e].inner : p.left[e].outer;
    for (int i = 0; i < kRows; ++i) {
      const float u = slope * float(first_row + i) + offset;
      low[i] = u > low[i] ? u : low[i];
    }
  }
  for (int e = 0; e < p.right_edges; ++e) {
    const float slope = p.right[e].slope, offset = inner ? p.right[e].inner : p.right[e].outer;
    for (int i = 0; i < kRows; ++i) {
      const float u = slope * float(first_row + i) + offset;
      high[i] = u < high[i] ? u : high[i];
    }
  }
  const float beyond = float(p.columns.last + 1);
  for (int i = 0; i < kRows; ++i) {
    const float l = low[i] < beyond ? low[i] : beyond, h = high[i] > -1.0f ? high[i] : -1.0f;
    const std::int32_t whole_l = std::int32_t(l), whole_h = std::int32_t(h);
    const std::int32_t begin = whole_l + std::int32_t(float(whole_l) < l);
    const std::int32_t end = whole_h + 1 - std::int32_t(float(whole_h) > h);
    const int row = first_row + i;
    const bool in_rows = (row >= rows.first) & (row <= rows.last);
    spans.begin[i] = begin;
    spans.end[i] = in_rows ? end : 0;
  }
}

[[gnu::always_inline]] inline std::int32_t within_block(std::int32_t column, std::int32_t first) {
  const std::int32_t c = column - first;
  const std::int32_t positive = c > 0 ? c : 0;
  return positive < kColumns ? positive : kColumns;
}

/// The lowest n bits, n from 0 to 32.
[[gnu::always_inline]] inline std::uint32_t low_bits(std::int32_t n) {
  const std::uint32_t ones = 0xFFFFFFFFu >> ((32 - n) & 31);
  return n > 0 ? ones : 0;
}

/// std::popcount, in a form that is vectorised everywhere.
[[gnu::always_inline]] inline std::int32_t bit_count(std::uint32_t x) {
  x -= (x >> 1) & 0x55555555u;
  x = (x & 0x33333333u) + ((x >> 2) & 0x33333333u);
  x = (x + (x >> 4)) & 0x0F0F0F0Fu;
  x += x >> 8;
  return std::int32_t((x + (x >> 16)) & 63);
}

[[gnu::always_inline]] inline void mark_possible(const RowSpans& spans, int first_column,
                                                 std::uint32_t* mask) {
  for (int i = 0; i < kRows; ++i) {
    mask[i] = low_bits(within_block(spans.end[i], first_column)) &
              ~low_bits(within_block(spans.begin[i], first_column));
  }
}

/// What a pixel in each row counts at most whose 1 / depth is `inverse`.
[[gnu::always_inline]] inline void weigh(const WeightBound& w, const float* inverse,
                                         float* weight) {
  alignas(64) float part[kRows];
  for (int i = 0; i < kRows; ++i) {
    const float depths_per_far = inverse[i] > w.per_far ? inverse[i] : w.per_far;
    part[i] = w.per_far / depths_per_far;
    weight[i] = w.factor;
  }
  for (int factor = 0; factor < w.power; ++factor) {
    for (int i = 0; i < kRows; ++i) weight[i] *= part[i];
  }
}

[[gnu::always_inline]] inline void draw_block(const FacePolygon& p, const WeightBound& w,
                                              const RowSpans& outer, const RowSpans& inner,
                                              int first_row, int first_column, CoverBlock& block) {
  alignas(64) std::uint32_t may[kRows], must[kRows];
  alignas(64) float left_inverse[kRows], right_inverse[kRows], left[kRows], right[kRows];
  mark_possible(outer, first_column, may);
  mark_possible(inner, first_column, must);
  for (int i = 0; i < kRows; ++i) {
    const float begin = float(first_column + within_block(inner.begin[i], first_column));
    const float last = float(first_column + within_block(inner.end[i], first_column) - 1);
    const float at_row = p.at_origin + p.per_v * float(first_row + i);
    left_inverse[i] = at_row + p.per_u * begin;
    right_inverse[i] = at_row + p.per_u * last;
  }
  weigh(w, left_inverse, left);
  weigh(w, right_inverse, right);
  const float doubtful = p.grazing ? w.anything : w.uncertain;
  for (int i = 0; i < kRows; ++i) {
    const std::uint32_t before = block.certain[i];
    const std::uint32_t fresh = must[i] & ~before, unsure = may[i] & ~must[i] & ~before;
    // depth^power is convex along a row: over a whole span it is the ends' mean at most.
    const float mean = 0.5f * (left[i] + right[i]);
    const float larger = left[i] > right[i] ? left[i] : right[i];
    const float each = fresh == must[i] ? mean : larger;
    block.bound[i] += float(bit_count(fresh)) * each + float(bit_count(unsure)) * doubtful;
    block.certain[i] = before | must[i];
    block.possible[i] |= may[i];
  }
}

/// The blocks that a polygon may touch.
struct Reach {
  int first_chunk, last_chunk, first_group, last_group;

  explicit Reach(const FacePolygon& p)
      : first_chunk(p.columns.first / kColumns),
        last_chunk(p.columns.last / kColumns),
        first_group(p.rows.first / kRows),
        last_group(p.rows.last / kRows) {}
};

VANTAGE_MULTIVERSION
void draw_polygon(const FacePolygon& p, const WeightBound& w, int origin_chunk, int origin_group,
                  int chunks, CoverBlock* blocks) {
  const Reach reach(p);
  RowSpans outer, inner;
  for (int group = reach.first_group; group <= reach.last_group; ++group) {
    find_spans(p, false, p.rows, group * kRows, outer);
    find_spans(p, true, p.certain_rows, group * kRows, inner);
    CoverBlock* row = blocks + (group - origin_group) * chunks - origin_chunk;
    for (int chunk = reach.first_chunk; chunk <= reach.last_chunk; ++chunk) {
      draw_block(p, w, outer, inner, group * kRows, chunk * kColumns, row[chunk]);
    }
  }
}

VANTAGE_MULTIVERSION
void draw_outline(const FacePolygon& p, int origin_chunk, int origin_group, int chunks,
                  CoverBlock* blocks) {
  const Reach reach(p);
  RowSpans outer;
  alignas(64) std::uint32_t may[kRows];
  for (int group = reach.first_group; group <= reach.last_group; ++group) {
    find_spans(p, false, p.rows, group * kRows, outer);
    CoverBlock* row = blocks + (group - origin_group) * chunks - origin_chunk;
    for (int chunk = reach.first_chunk; chunk <= reach.last_chunk; ++chunk) {
      mark_possible(outer, chunk * kColumns, may);
      for (int i = 0; i < kRows; ++i) row[chunk].possible[i] |= may[i];
    }
  }
}

}  // namespace

ViewCover::ViewCover(PixelSpan columns, PixelSpan rows)
    : first_chunk_(columns.first / kColumns),
      chunks_(columns.last / kColumns - first_chunk_ + 1),
      first_group_(rows.first / kRows),
      blocks_(std::size_t(chunks_) * std::size_t(rows.last / kRows - first_group_ + 1)) {}

void ViewCover::draw(const FacePolygon& polygon, const WeightBound& weight) {
  draw_polygon(polygon, weight, first_chunk_, first_group_, chunks_, blocks_.data());
}

void ViewCover::draw_possible(const FacePolygon& polygon) {
  draw_outline(polygon, first_chunk_, first_group_, chunks_, blocks_.data());
}

bool ViewCover::empty_block(std::size_t block) const {
  std::uint32_t any = 0;
  for (const std::uint32_t row : blocks_[block].possible) any |= row;
  return any == 0;
}

Score ViewCover::bound(std::size_t block) const {
  // Rounding in float, and of each pixel's weight to a whole step.
  constexpr double kRounding = 1 + 1e-4;
  double sum = 0;
  for (const float row : blocks_[block].bound) sum += double(row);
  return sum > 0 ? Score(sum * kRounding) + kRows * kColumns : 0;
}

std::span<const PixelTile> ViewCover::tiles(std::size_t block,
                                            std::span<PixelTile, 32> room) const {
  constexpr int kSide = PixelTile::kSide;
  const int chunk = first_chunk_ + int(block) % chunks_,
            group = first_group_ + int(block) / chunks_;
  const std::uint32_t* rows = blocks_[block].possible;
  std::size_t count = 0;
  for (int down = 0; down < kRows / kSide; ++down, rows += kSide) {
    std::uint32_t any = rows[0] | rows[1] | rows[2] | rows[3];
    for (int across = chunk * kColumns / kSide; any != 0; ++across, any >>= kSide) {
      if ((any & 0xF) == 0) continue;
      room[count++] = {std::uint16_t(across), std::uint16_t(group * kRows / kSide + down)};
    }
  }
  return room.first(count);
}

}  // namespace vantage::detail
