#include "shadow_border.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <vector>

#include "depth_weight.hpp"
#include "view_cover.hpp"

namespace vantage::detail {
namespace {

constexpr int kSide = PixelTile::kSide;

/// The tiles that may show shadow, column by column and row by row.
class CandidateTiles {
 public:
  explicit CandidateTiles(const ShadowInView& shadow)
      : first_column_(shadow.columns.first / kSide),
        first_row_(shadow.rows.first / kSide),
        columns_(shadow.columns.last / kSide - first_column_ + 1),
        rows_(shadow.rows.last / kSide - first_row_ + 1),
        is_candidate_(std::size_t(columns_) * std::size_t(rows_)) {
    ViewCover cover(shadow.columns, shadow.rows);
    for (const FacePolygon& face : shadow.faces) cover.draw_possible(face);
    std::array<PixelTile, 32> room;
    for (std::size_t block = 0; block < cover.block_count(); ++block) {
      for (const PixelTile tile : cover.tiles(block, room)) {
        is_candidate_[index(tile.column, tile.row)] = 1;
      }
    }
  }

  int first_column() const { return first_column_; }
  int first_row() const { return first_row_; }
  int last_column() const { return first_column_ + columns_ - 1; }
  int last_row() const { return first_row_ + rows_ - 1; }

  /// Moves a tile from the list of candidates to `tiles`, if it is one.
  void take(int column, int row, std::vector<PixelTile>& tiles) {
    char& candidate = is_candidate_[index(column, row)];
    if (candidate != 0) tiles.push_back({std::uint16_t(column), std::uint16_t(row)});
    candidate = 0;
  }

 private:
  std::size_t index(int column, int row) const {
    return std::size_t(row - first_row_) * std::size_t(columns_) +
           std::size_t(column - first_column_);
  }

  int first_column_, first_row_, columns_, rows_;
  std::vector<char> is_candidate_;
};

/// Traces tiles from the borders inwards.
class BorderScan {
 public:
  BorderScan(const PlanningScene& scene, const PinholeCamera& view, const ShadowInView& shadow)
      : scene_(scene),
        view_(view),
        tiles_(shadow),
        bounds_{view.intrinsics().width, -1, view.intrinsics().height, -1} {}

  std::optional<ShadowBounds> find() {
    int top = tiles_.first_row();
    while (top <= tiles_.last_row() && bounds_.right < 0) trace_row(top++);
    if (bounds_.right < 0) return std::nullopt;
    // Tiles that can only lie further in than a pixel that is known need not be looked at.
    for (int row = tiles_.last_row(); kSide * row + kSide - 1 > bounds_.bottom; --row)
      trace_row(row);
    for (int c = tiles_.first_column(); kSide * c < bounds_.left; ++c) trace_column(c);
    for (int c = tiles_.last_column(); kSide * c + kSide - 1 > bounds_.right; --c) trace_column(c);
    return bounds_;
  }

 private:
  void trace_row(int row) {
    for (int c = tiles_.first_column(); c <= tiles_.last_column(); ++c) tiles_.take(c, row, line_);
    trace_line();
  }
  void trace_column(int column) {
    for (int r = bounds_.top / kSide; r <= bounds_.bottom / kSide; ++r) {
      tiles_.take(column, r, line_);
    }
    trace_line();
  }

  void trace_line() {
    hits_.resize(line_.size());
    scene_.surfaces().first_hits(view_, line_, hits_);
    for (std::size_t i = 0; i < line_.size(); ++i) {
      add(line_[i], shadow_pixels(view_.intrinsics(), view_.range(), scene_.shadow_object(),
                                  line_[i], hits_[i]));
    }
    line_.clear();
  }

  void add(PixelTile tile, std::uint16_t shown) {
    if (shown == 0) return;
    const unsigned columns = (shown | shown >> 4 | shown >> 8 | shown >> 12) & 0xF;
    const int u = kSide * tile.column, v = kSide * tile.row;
    bounds_.left = std::min(bounds_.left, u + std::countr_zero(columns));
    bounds_.right = std::max(bounds_.right, u + int(std::bit_width(columns)) - 1);
    bounds_.top = std::min(bounds_.top, v + std::countr_zero(shown) / kSide);
    bounds_.bottom = std::max(bounds_.bottom, v + (int(std::bit_width(shown)) - 1) / kSide);
  }

  const PlanningScene& scene_;
  const PinholeCamera& view_;
  CandidateTiles tiles_;
  ShadowBounds bounds_;
  std::vector<PixelTile> line_;
  std::vector<TileHits> hits_;
};

}  // namespace

std::optional<ShadowBounds> find_shadow_bounds(const PlanningScene& scene,
                                               const PinholeCamera& view,
                                               const ShadowInView& shadow) {
  return BorderScan(scene, view, shadow).find();
}

}  // namespace vantage::detail
