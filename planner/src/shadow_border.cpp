#include "shadow_border.hpp"

#include <array>
#include <vector>

#include "depth_weight.hpp"
#include "tile_bounds.hpp"
#include "view_cover.hpp"

namespace vantage::detail {
namespace {

constexpr int kSide = PixelTile::kSide;

// Few enough that what they show spares many of those behind them, enough to be worth a call.
constexpr std::size_t kBatchTiles = 8;

/// Which pixels may show shadow and have not been looked at, tile by tile.
class OpenTiles {
 public:
  explicit OpenTiles(const ShadowOutline& shadow)
      : first_{std::uint16_t(shadow.columns.first / kSide),
               std::uint16_t(shadow.rows.first / kSide)},
        last_{std::uint16_t(shadow.columns.last / kSide), std::uint16_t(shadow.rows.last / kSide)},
        columns_(std::size_t(last_.column - first_.column) + 1),
        pixels_(columns_ * (std::size_t(last_.row - first_.row) + 1)) {
    ViewCover cover(shadow.columns, shadow.rows);
    for (const FacePolygon& face : shadow.faces) cover.draw_possible(face);
    std::array<PixelTile, 32> room;
    for (std::size_t block = 0; block < cover.block_count(); ++block) {
      for (const PixelTile tile : cover.tiles(block, room)) at(tile) = cover.possible(block, tile);
    }
  }

  PixelTile first() const { return first_; }
  PixelTile last() const { return last_; }
  std::uint16_t& at(PixelTile tile) {
    return pixels_[std::size_t(tile.row - first_.row) * columns_ +
                   std::size_t(tile.column - first_.column)];
  }

 private:
  PixelTile first_, last_;
  std::size_t columns_;
  std::vector<std::uint16_t> pixels_;
};

/// Traces tiles from the borders inwards, as long as they may widen the bounds.
class BorderScan {
 public:
  BorderScan(const PlanningScene& scene, const PinholeCamera& view, const ShadowOutline& shadow)
      : scene_(scene),
        view_(view),
        open_(shadow),
        bounds_{view.intrinsics().width, -1, view.intrinsics().height, -1} {}

  std::optional<ShadowBounds> find() {
    const PixelTile first = open_.first(), last = open_.last();
    for (int row = first.row; row <= last.row && kSide * row < bounds_.top; ++row) {
      trace_row(row, [&](const ShadowBounds& b) { return b.top < bounds_.top; });
    }
    if (bounds_.right < 0) return std::nullopt;
    for (int row = last.row; kSide * row + kSide - 1 > bounds_.bottom; --row) {
      trace_row(row, [&](const ShadowBounds& b) { return b.bottom > bounds_.bottom; });
    }
    for (int column = first.column; kSide * column < bounds_.left; ++column) {
      trace_column(column, [&](const ShadowBounds& b) { return b.left < bounds_.left; });
    }
    for (int column = last.column; kSide * column + kSide - 1 > bounds_.right; --column) {
      trace_column(column, [&](const ShadowBounds& b) { return b.right > bounds_.right; });
    }
    return bounds_;
  }

 private:
  template <class MayWiden>
  void trace_row(int row, const MayWiden& may_widen) {
    for (int column = open_.first().column; column <= open_.last().column; ++column) {
      add({std::uint16_t(column), std::uint16_t(row)}, may_widen);
    }
    trace_batch();
  }
  template <class MayWiden>
  void trace_column(int column, const MayWiden& may_widen) {
    for (int row = bounds_.top / kSide; row <= bounds_.bottom / kSide; ++row) {
      add({std::uint16_t(column), std::uint16_t(row)}, may_widen);
    }
    trace_batch();
  }
  template <class MayWiden>
  void add(PixelTile tile, const MayWiden& may_widen) {
    std::uint16_t& pixels = open_.at(tile);
    if (pixels == 0 || !may_widen(bounds_of(tile, pixels))) return;
    pixels = 0;
    batch_[batch_size_++] = tile;
    if (batch_size_ == kBatchTiles) trace_batch();
  }

  void trace_batch() {
    const std::span<const PixelTile> tiles(batch_.data(), batch_size_);
    scene_.surfaces().first_hits(view_, tiles, std::span(hits_.data(), batch_size_));
    for (std::size_t i = 0; i < batch_size_; ++i) {
      const unsigned shown = shadow_pixels(view_.intrinsics(), view_.range(),
                                           scene_.shadow_object(), tiles[i], hits_[i]);
      if (shown == 0) continue;
      bounds_ = joined(bounds_, bounds_of(tiles[i], shown));
    }
    batch_size_ = 0;
  }

  const PlanningScene& scene_;
  const PinholeCamera& view_;
  OpenTiles open_;
  ShadowBounds bounds_;
  std::array<PixelTile, kBatchTiles> batch_;
  std::array<TileHits, kBatchTiles> hits_;
  std::size_t batch_size_ = 0;
};

}  // namespace

std::optional<ShadowBounds> find_shadow_bounds(const PlanningScene& scene,
                                               const PinholeCamera& view,
                                               const ShadowOutline& shadow) {
  return BorderScan(scene, view, shadow).find();
}

}  // namespace vantage::detail
