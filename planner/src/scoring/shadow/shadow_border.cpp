#include "scoring/shadow/shadow_border.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <tuple>
#include <utility>
#include <vector>

#include "scene/tile_bounds.hpp"
#include "scoring/shadow/depth_weight.hpp"
#include "scoring/shadow/masked_rasterizer.hpp"

namespace vantage::planner::detail {
namespace {

constexpr int kSide = PixelTile::kSide;

// Few enough that what they show spares many of those behind them, enough to be worth a call.
constexpr std::size_t kBatchTiles = 4;

/// Traces tiles from the borders inwards, as long as they may widen the bounds. Which tiles may
/// show shadow is drawn as the scan comes to them: faces within the bounds never are.
class BorderScan {
 public:
  BorderScan(const PlanningScene& scene, const PinholeCamera& view, const ShadowFaces& faces)
      : scene_(scene),
        view_(view),
        projector_(project_shadow(view, faces, scene.grid())),
        bounds_{view.intrinsics().width, -1, view.intrinsics().height, -1} {}

  ShadowObservation find(const std::optional<ExtremePoints>& expected) {
    open_image();
    if (columns_.last < 0) return {};
    if (expected) trace_at(*expected);
    for (int row = first_.row; row <= last_.row && kSide * row < bounds_.top; ++row) {
      draw_groups([&](const Group& g) { return g.rows.first < kSide * (row + 1); });
      trace_row(row, [&](const ShadowBounds& b) { return b.top < bounds_.top; });
    }
    if (bounds_.right < 0) return {};
    top_is_known_ = true;
    for (int row = last_.row; kSide * row + kSide - 1 > bounds_.bottom; --row) {
      draw_groups([&](const Group& g) { return g.rows.last >= kSide * row; });
      trace_row(row, [&](const ShadowBounds& b) { return b.bottom > bounds_.bottom; });
    }
    bottom_is_known_ = true;
    for (int column = first_.column; kSide * column < bounds_.left; ++column) {
      draw_groups([&](const Group& g) { return g.columns.first < kSide * (column + 1); });
      trace_column(column, [&](const ShadowBounds& b) { return b.left < bounds_.left; });
    }
    left_is_known_ = true;
    for (int column = last_.column; kSide * column + kSide - 1 > bounds_.right; --column) {
      draw_groups([&](const Group& g) { return g.columns.last >= kSide * column; });
      trace_column(column, [&](const ShadowBounds& b) { return b.right > bounds_.right; });
    }
    return {.bounds = bounds_, .extremes = extremes_};
  }

 private:
  using Group = FaceProjector::GroupInView;

  /// Finds where on the image there may be shadow at all.
  void open_image() {
    if (too_uncertain(projector_, view_)) {
      columns_ = {0, view_.intrinsics().width - 1}, rows_ = {0, view_.intrinsics().height - 1};
    } else {
      for (const Group& group : projector_.groups()) {
        waiting_.push_back(&group);
        widen(columns_, group.columns), widen(rows_, group.rows);
      }
    }
    if (columns_.last < 0) return;
    first_ = {std::uint16_t(columns_.first / kSide), std::uint16_t(rows_.first / kSide)};
    last_ = {std::uint16_t(columns_.last / kSide), std::uint16_t(rows_.last / kSide)};
    cover_.emplace(columns_, rows_);
    traced_.resize(std::size_t(last_.column - first_.column + 1) *
                   std::size_t(last_.row - first_.row + 1));
    if (waiting_.empty()) cover_->draw_possible(whole_image(view_));
  }

  /// Whether what lies in these columns and rows may widen the bounds where they are not known.
  bool matters(const PixelSpan& columns, const PixelSpan& rows) const {
    return (!top_is_known_ && rows.first < bounds_.top) ||
           (!bottom_is_known_ && rows.last > bounds_.bottom) ||
           (!left_is_known_ && columns.first < bounds_.left) || columns.last > bounds_.right;
  }

  template <class IsNext>
  void draw_groups(const IsNext& is_next) {
    const auto matter = [&](const FacePolygon& p) { return matters(p.columns, p.rows); };
    FacePolygon polygon;
    std::erase_if(waiting_, [&](const Group* group) {
      if (!matters(group->columns, group->rows)) return true;
      if (!is_next(*group)) return false;
      projector_.for_each_face(*group, [&](const FlatFaces::Face& face) {
        if (projector_.project_outline(face, matter, polygon)) cover_->draw_possible(polygon);
      });
      return true;
    });
  }

  /// Looks first where the shadow's outermost points are expected to be.
  void trace_at(const ExtremePoints& points) {
    static_assert(kBatchTiles >= std::tuple_size_v<ExtremePoints>);
    for (const Eigen::Vector3d& point : points) {
      const auto at = view_.project(point);
      if (!at) continue;
      const double column = std::floor((at->u + 0.5) / kSide),
                   row = std::floor((at->v + 0.5) / kSide);
      if (!(column >= first_.column && column <= last_.column)) continue;
      if (!(row >= first_.row && row <= last_.row)) continue;
      open_tile({std::uint16_t(column), std::uint16_t(row)});
    }
    trace_batch();
  }

  template <class MayWiden>
  void trace_row(int row, const MayWiden& may_widen) {
    cover_->for_each_in_row(
        row, first_.column, last_.column,
        [&](PixelTile tile, std::uint16_t pixels) { add(tile, pixels, may_widen); });
    trace_batch();
  }
  template <class MayWiden>
  void trace_column(int column, const MayWiden& may_widen) {
    for (int row = bounds_.top / kSide; row <= bounds_.bottom / kSide; ++row) {
      const PixelTile tile{std::uint16_t(column), std::uint16_t(row)};
      if (const std::uint16_t pixels = cover_->possible(tile); pixels != 0) {
        add(tile, pixels, may_widen);
      }
    }
    trace_batch();
  }
  template <class MayWiden>
  void add(PixelTile tile, std::uint16_t pixels, const MayWiden& may_widen) {
    if (traced(tile) != 0 || !may_widen(bounds_of(tile, pixels))) return;
    open_tile(tile);
    if (batch_size_ == kBatchTiles) trace_batch();
  }

  std::uint8_t& traced(PixelTile tile) {
    return traced_[std::size_t(tile.row - first_.row) *
                       std::size_t(last_.column - first_.column + 1) +
                   std::size_t(tile.column - first_.column)];
  }

  void open_tile(PixelTile tile) {
    if (std::exchange(traced(tile), std::uint8_t(1)) == 0) batch_[batch_size_++] = tile;
  }

  void trace_batch() {
    if (batch_size_ == 0) return;
    const std::span<const PixelTile> tiles(batch_.data(), batch_size_);
    scene_.surfaces().first_hits(view_, tiles, std::span(hits_.data(), batch_size_));
    for (std::size_t i = 0; i < batch_size_; ++i) {
      const unsigned shown = shadow_pixels(view_.intrinsics(), view_.range(),
                                           scene_.shadow_object(), tiles[i], hits_[i]);
      if (shown != 0) widen_to(tiles[i], shown, hits_[i]);
    }
    batch_size_ = 0;
  }

  void widen_to(PixelTile tile, unsigned shown, const TileHits& hits) {
    const ShadowBounds b = bounds_of(tile, shown),
                       before = std::exchange(bounds_, joined(bounds_, b));
    if (bounds_ == before) return;
    for (unsigned pixels = shown; pixels != 0; pixels &= pixels - 1) {
      const int i = std::countr_zero(pixels);
      const int u = kSide * tile.column + i % kSide, v = kSide * tile.row + i / kSide;
      const auto keep = [&](bool extremes, std::size_t border) {
        if (extremes) extremes_[border] = view_.unproject(u, v, double(hits.t[i]));
      };
      keep(u == b.left && b.left < before.left, 0);
      keep(u == b.right && b.right > before.right, 1);
      keep(v == b.top && b.top < before.top, 2);
      keep(v == b.bottom && b.bottom > before.bottom, 3);
    }
  }

  const PlanningScene& scene_;
  const PinholeCamera& view_;
  FaceProjector projector_;
  std::vector<const Group*> waiting_;  ///< whose faces are not drawn
  PixelSpan columns_{0, -1}, rows_{0, -1};
  PixelTile first_, last_;
  std::optional<ViewCover> cover_;
  std::vector<std::uint8_t> traced_;  ///< tiles, row by row
  ShadowBounds bounds_;
  ExtremePoints extremes_;  ///< left, right, top, bottom
  bool top_is_known_ = false, bottom_is_known_ = false, left_is_known_ = false;
  std::array<PixelTile, kBatchTiles> batch_;
  std::array<TileHits, kBatchTiles> hits_;
  std::size_t batch_size_ = 0;
};

}  // namespace

ShadowObservation find_shadow_border(const PlanningScene& scene, const PinholeCamera& view,
                                     const ShadowFaces& faces,
                                     const std::optional<ExtremePoints>& expected) {
  return BorderScan(scene, view, faces).find(expected);
}

}  // namespace vantage::planner::detail
