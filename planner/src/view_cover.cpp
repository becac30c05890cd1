#include "view_cover.hpp"

#include <algorithm>
#include <cstring>

#include "vantage/raycore/multiversion.hpp"

// Vectors wider than the default instruction set's are passed between functions that are inlined,
// so that there is no calling convention to change.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace vantage::detail {
namespace {

constexpr int kRows = CoverBlock::kRows, kColumns = CoverBlock::kColumns;

/// One element for each row of a block.
using Floats = float __attribute__((vector_size(4 * kRows)));
using Ints = std::int32_t __attribute__((vector_size(4 * kRows)));
using Bits = std::uint32_t __attribute__((vector_size(4 * kRows)));

constexpr Ints kCount = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

#define VANTAGE_INLINE [[gnu::always_inline]] inline

VANTAGE_INLINE Floats to_floats(const Ints& x) {
  return __builtin_convertvector(x, Floats);
}
VANTAGE_INLINE Ints to_ints(const Floats& x) {
  return __builtin_convertvector(x, Ints);
}

template <class Lanes>
VANTAGE_INLINE Lanes load(const void* from) {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
template <class Lanes>
VANTAGE_INLINE void store(const Lanes& lanes, void* to) {
  std::memcpy(to, &lanes, sizeof lanes);
}

/// Pixels begin ≤ u < end of each row.
struct RowSpans {
  Ints begin, end;
};

/// The columns between a polygon's edges, rounded to the pixels within.
template <float PolygonEdge::*kOffset>
VANTAGE_INLINE RowSpans find_spans(const FacePolygon& p, PixelSpan rows, int first_row) {
  const Ints row = first_row + kCount;
  const Floats v = to_floats(row);
  Floats low = Floats{} + float(p.columns.first), high = Floats{} + float(p.columns.last);
  for (int e = 0; e < p.left_edges; ++e) {
    const Floats u = p.left[e].slope * v + p.left[e].*kOffset;
    low = u > low ? u : low;
  }
  for (int e = 0; e < p.right_edges; ++e) {
    const Floats u = p.right[e].slope * v + p.right[e].*kOffset;
    high = u < high ? u : high;
  }
  const Floats beyond = Floats{} + float(p.columns.last + 1), before = Floats{} - 1.0f;
  low = low < beyond ? low : beyond;
  high = high > before ? high : before;
  const Ints whole_low = to_ints(low), whole_high = to_ints(high);
  // A comparison is -1 where it is true.
  const Ints begin = whole_low - (to_floats(whole_low) < low);
  const Ints end = whole_high + 1 + (to_floats(whole_high) > high);
  return {begin, end & (row >= rows.first) & (row <= rows.last)};
}

VANTAGE_INLINE Ints within_block(const Ints& column, int first) {
  const Ints c = column - first, none = Ints{}, all = Ints{} + kColumns;
  const Ints positive = c > none ? c : none;
  return positive < all ? positive : all;
}

/// The lowest n bits, n from 0 to 32.
VANTAGE_INLINE Bits low_bits(const Ints& n) {
  const Bits ones = (Bits{} + 0xFFFFFFFFu) >> (Bits)((32 - n) & 31);
  return n > 0 ? ones : Bits{};
}

VANTAGE_INLINE Bits span_bits(const Ints& begin, const Ints& end) {
  return low_bits(end) & ~low_bits(begin);
}

/// std::popcount in plain operations.
VANTAGE_INLINE Floats bit_count(Bits x) {
  x -= (x >> 1) & 0x55555555u;
  x = (x & 0x33333333u) + ((x >> 2) & 0x33333333u);
  x = (x + (x >> 4)) & 0x0F0F0F0Fu;
  x += x >> 8;
  return to_floats((Ints)((x + (x >> 16)) & 63u));
}

VANTAGE_INLINE Floats weight_of(const WeightBound& w, const Floats& inverse) {
  const Floats part = w.per_far / inverse;
  Floats weight = Floats{} + w.factor;
  for (int factor = 0; factor < w.power; ++factor) weight *= part;
  return weight;
}

/// What a face's pixels count at the columns where blocks meet.
struct Node {
  Floats inverse, weight;
};
VANTAGE_INLINE Node node_at(const FacePolygon& p, const WeightBound& w, int row, int column) {
  const Floats inverse =
      (p.at_origin + p.per_u * float(column)) + p.per_v * to_floats(row + kCount);
  const Floats least = Floats{} + 0.25f * p.least_inverse;
  return {inverse, weight_of(w, inverse > least ? inverse : least)};
}

/// What each of the pixels begin … end - 1 of a block counts on average, or if not all of them do,
/// at most. depth^power is convex along a row, so that it is below the straight line between the
/// block's two ends, unless the face's plane is behind the camera there.
VANTAGE_INLINE Floats weight_of_each(const FacePolygon& p, float largest, const Node& left,
                                     const Node& right, const Floats& begin, const Floats& end,
                                     const Ints& all) {
  const Floats slope = (right.weight - left.weight) * (1.0f / kColumns);
  const Floats first = left.weight + slope * begin, last = left.weight + slope * (end - 1.0f);
  const Floats mean = 0.5f * (first + last), larger = first > last ? first : last;
  const Floats line = all ? mean : larger, most = Floats{} + largest;
  const Floats least = Floats{} + 0.25f * p.least_inverse;
  return ((left.inverse > least) & (right.inverse > least) & (line < most)) ? line : most;
}

/// What is the same for all blocks of a polygon.
struct Drawing {
  const FacePolygon& polygon;
  float largest;   ///< weight of its farthest point
  float doubtful;  ///< weight of pixels that may show it or not
};

VANTAGE_INLINE void draw_block(const Drawing& d, const RowSpans& outer, const RowSpans& inner,
                               const Node& left, const Node& right, int first_column,
                               CoverBlock& block) {
  const Bits may =
      span_bits(within_block(outer.begin, first_column), within_block(outer.end, first_column));
  const Ints begin = within_block(inner.begin, first_column);
  const Ints end = within_block(inner.end, first_column);
  const Bits must = span_bits(begin, end), before = load<Bits>(block.certain);
  const Bits fresh = must & ~before, unsure = may & ~must & ~before;
  const Floats each = weight_of_each(d.polygon, d.largest, left, right, to_floats(begin),
                                     to_floats(end), fresh == must);
  store(load<Floats>(block.bound) + bit_count(fresh) * each + bit_count(unsure) * d.doubtful,
        block.bound);
  store(before | must, block.certain);
  store(load<Bits>(block.possible) | may, block.possible);
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
  const Drawing drawing{p, weight_of(w, Floats{} + p.least_inverse)[0],
                        p.grazing ? w.anything : w.uncertain};
  for (int group = reach.first_group; group <= reach.last_group; ++group) {
    const int row = group * kRows;
    const RowSpans outer = find_spans<&PolygonEdge::outer>(p, p.rows, row);
    const RowSpans inner = find_spans<&PolygonEdge::inner>(p, p.certain_rows, row);
    CoverBlock* block_row = blocks + (group - origin_group) * chunks - origin_chunk;
    Node left = node_at(p, w, row, reach.first_chunk * kColumns);
    for (int chunk = reach.first_chunk; chunk <= reach.last_chunk; ++chunk) {
      const Node right = node_at(p, w, row, (chunk + 1) * kColumns);
      draw_block(drawing, outer, inner, left, right, chunk * kColumns, block_row[chunk]);
      left = right;
    }
  }
}

VANTAGE_MULTIVERSION
void draw_outline(const FacePolygon& p, int origin_chunk, int origin_group, int chunks,
                  CoverBlock* blocks) {
  const Reach reach(p);
  for (int group = reach.first_group; group <= reach.last_group; ++group) {
    const RowSpans outer = find_spans<&PolygonEdge::outer>(p, p.rows, group * kRows);
    CoverBlock* block_row = blocks + (group - origin_group) * chunks - origin_chunk;
    for (int chunk = reach.first_chunk; chunk <= reach.last_chunk; ++chunk) {
      const Bits may = span_bits(within_block(outer.begin, chunk * kColumns),
                                 within_block(outer.end, chunk * kColumns));
      store(load<Bits>(block_row[chunk].possible) | may, block_row[chunk].possible);
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
