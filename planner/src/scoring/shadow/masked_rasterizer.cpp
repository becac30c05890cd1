#include "scoring/shadow/masked_rasterizer.hpp"

#include <algorithm>
#include <cmath>

#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage::planner::detail {
namespace {

constexpr int kRows = CoverBlock::kRows, kColumns = CoverBlock::kColumns;

/// What is the same for all blocks of a polygon.
struct Drawing {
  const FacePolygon& polygon;
  const WeightBound& weight;
  float largest;   ///< weight of its farthest point
  float doubtful;  ///< weight of pixels that may show it or not
  float least;     ///< 1 / depth below which no line between weights is trusted

  Drawing(const FacePolygon& p, const WeightBound& w)
      : polygon(p),
        weight(w),
        largest(w.factor),
        doubtful(p.grazing ? w.anything : w.uncertain),
        least(0.25f * p.min_inverse) {
    for (int factor = 0; factor < w.power; ++factor) largest *= w.per_far / p.min_inverse;
  }
};

/// What a face's pixels count at the two ends of each row's span.
struct EndWeights {
  RowLanes<float> first, last;
  RowLanes<std::int32_t> trusted;
};

[[gnu::always_inline]] inline void find_weights(const Drawing& d, int first_row, int first_column,
                                                const RowLanes<std::int32_t>& begin,
                                                const RowLanes<std::int32_t>& end,
                                                EndWeights& ends) {
  const float per_far = d.weight.per_far, least = d.least;
  RowLanes<float> first, last;  // depth / far, squared again and again
  VANTAGE_EACH_ROW(i) {
    const float at_row = d.polygon.at_origin + d.polygon.per_v * float(first_row + i);
    const float p = at_row + d.polygon.per_u * float(first_column + begin.at[i]);
    const float q = at_row + d.polygon.per_u * float(first_column + end.at[i] - 1);
    ends.trusted.at[i] = (p > least) & (q > least);
    first.at[i] = per_far / (p > least ? p : least);
    last.at[i] = per_far / (q > least ? q : least);
    ends.first.at[i] = ends.last.at[i] = d.weight.factor;
  }
  for (int power = d.weight.power; power > 0; power >>= 1) {
    if ((power & 1) != 0) {
      VANTAGE_EACH_ROW(i) {
        ends.first.at[i] *= first.at[i];
        ends.last.at[i] *= last.at[i];
      }
    }
    VANTAGE_EACH_ROW(i) {
      first.at[i] *= first.at[i];
      last.at[i] *= last.at[i];
    }
  }
}

/// Adds to each row what its fresh pixels count at most. Pixels that are possible and not certain
/// are not fresh: they count already, as much as any face that is not grazing. depth^power is
/// convex along a row, so that it is below the straight line between a span's two ends, unless
/// rounding puts the face's plane behind the camera there. On that line, all pixels of a span count
/// their mean, some at most the larger end.
[[gnu::always_inline]] inline void draw_block(const Drawing& d, const RowSpans& outer,
                                              const RowSpans& inner, int first_row,
                                              int first_column, CoverBlock& block) {
  RowLanes<std::int32_t> begin, end, may_begin, may_end;
  VANTAGE_EACH_ROW(i) {
    begin.at[i] = within_block(inner.begin.at[i], first_column);
    end.at[i] = within_block(inner.end.at[i], first_column);
    may_begin.at[i] = within_block(outer.begin.at[i], first_column);
    may_end.at[i] = within_block(outer.end.at[i], first_column);
  }
  RowLanes<std::uint32_t> must, may;
  VANTAGE_EACH_ROW(i) {
    must.at[i] = span_bits(begin.at[i], end.at[i]);
    may.at[i] = span_bits(may_begin.at[i], may_end.at[i]);
  }
  RowLanes<std::uint32_t> fresh, unsure;
  std::uint32_t any = 0;
  const std::uint32_t counted_once = d.polygon.grazing ? 0 : 0xFFFFFFFFu;
  VANTAGE_EACH_ROW(i) {
    const std::uint32_t open = ~block.certain[i];
    const std::uint32_t new_here = open & ~(block.possible[i] & counted_once);
    fresh.at[i] = must.at[i] & new_here;
    unsure.at[i] = may.at[i] & ~must.at[i] & new_here;
    any |= may.at[i] & open;
  }
  if (any == 0) return;
  RowLanes<float> fresh_count, unsure_count, some;
  VANTAGE_EACH_ROW(i) {
    fresh_count.at[i] = bit_count(fresh.at[i]);
    unsure_count.at[i] = bit_count(unsure.at[i]);
    some.at[i] = float(std::int32_t(fresh.at[i] != must.at[i]));
    block.certain[i] |= must.at[i];
    block.possible[i] |= fresh.at[i] | unsure.at[i];
  }
  EndWeights ends;
  find_weights(d, first_row, first_column, begin, end, ends);
  const float largest = d.largest, doubtful = d.doubtful;
  VANTAGE_EACH_ROW(i) {
    const float first = ends.first.at[i], last = ends.last.at[i];
    const float doubt = float(1 - ends.trusted.at[i]);
    const float line =
        0.5f * (first + last) + some.at[i] * 0.5f * std::fabs(last - first) + doubt * largest;
    const float each = line < largest ? line : largest;
    block.bound[i] += fresh_count.at[i] * each + unsure_count.at[i] * doubtful;
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

[[gnu::always_inline]] inline void draw_polygon_body(const FacePolygon& p, const WeightBound& w,
                                                     int origin_chunk, int origin_group, int chunks,
                                                     CoverBlock* blocks) {
  const Reach reach(p);
  const Drawing drawing(p, w);
  RowSpans outer, inner;
  for (int group = reach.first_group; group <= reach.last_group; ++group) {
    const int row = group * kRows;
    find_spans<&PolygonEdge::outer>(p, p.rows, row, outer);
    find_spans<&PolygonEdge::inner>(p, p.certain_rows, row, inner);
    const int block_row = (group - origin_group) * chunks - origin_chunk;
    for (int chunk = reach.first_chunk; chunk <= reach.last_chunk; ++chunk) {
      draw_block(drawing, outer, inner, row, chunk * kColumns, blocks[block_row + chunk]);
    }
  }
}
constexpr Multiversion<draw_polygon_body> draw_polygon;

/// Sets the bits of one mask of the blocks.
template <float PolygonEdge::*kOffset, auto kMask>
[[gnu::always_inline]] inline void draw_mask(const FacePolygon& p, PixelSpan rows, int origin_chunk,
                                             int origin_group, int chunks, CoverBlock* blocks) {
  const Reach reach(p);
  RowSpans spans;
  RowLanes<std::int32_t> begin, end;
  for (int group = reach.first_group; group <= reach.last_group; ++group) {
    find_spans<kOffset>(p, rows, group * kRows, spans);
    const int block_row = (group - origin_group) * chunks - origin_chunk;
    for (int chunk = reach.first_chunk; chunk <= reach.last_chunk; ++chunk) {
      std::uint32_t* mask = blocks[block_row + chunk].*kMask;
      VANTAGE_EACH_ROW(i) {
        begin.at[i] = within_block(spans.begin.at[i], chunk * kColumns);
        end.at[i] = within_block(spans.end.at[i], chunk * kColumns);
      }
      VANTAGE_EACH_ROW(i) mask[i] |= span_bits(begin.at[i], end.at[i]);
    }
  }
}

[[gnu::always_inline]] inline void draw_outline_body(const FacePolygon& p, int origin_chunk,
                                                     int origin_group, int chunks,
                                                     CoverBlock* blocks) {
  draw_mask<&PolygonEdge::outer, &CoverBlock::possible>(p, p.rows, origin_chunk, origin_group,
                                                        chunks, blocks);
}
constexpr Multiversion<draw_outline_body> draw_outline;

[[gnu::always_inline]] inline void draw_inside_body(const FacePolygon& p, int origin_chunk,
                                                    int origin_group, int chunks,
                                                    CoverBlock* blocks) {
  draw_mask<&PolygonEdge::inner, &CoverBlock::certain>(p, p.certain_rows, origin_chunk,
                                                       origin_group, chunks, blocks);
}
constexpr Multiversion<draw_inside_body> draw_inside;

}  // namespace

ViewCover::ViewCover(PixelSpan columns, PixelSpan rows)
    : first_chunk_(columns.first / kColumns),
      chunks_(columns.last / kColumns - first_chunk_ + 1),
      first_group_(rows.first / kRows),
      blocks_(std::size_t(chunks_) * std::size_t(rows.last / kRows - first_group_ + 1)) {}

void ViewCover::draw(const FacePolygon& polygon, const WeightBound& weight) {
  draw_polygon(polygon, weight, first_chunk_, first_group_, chunks_, blocks_.data());
}

void ViewCover::draw_occluder(const FacePolygon& polygon) {
  draw_inside(polygon, first_chunk_, first_group_, chunks_, blocks_.data());
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

}  // namespace vantage::planner::detail
