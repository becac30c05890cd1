#include "vantage/planner/shadow_scorer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "depth_weight.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

// Some microseconds of rays: their hits stay in the first cache, and `stop` is seen soon enough.
constexpr std::size_t kBatchTiles = 128;

std::vector<PixelTile> all_tiles(const Intrinsics& image) {
  constexpr int kSide = PixelTile::kSide;
  std::vector<PixelTile> tiles;
  for (int row = 0; kSide * row < image.height; ++row) {
    for (int column = 0; kSide * column < image.width; ++column) {
      tiles.push_back({std::uint16_t(column), std::uint16_t(row)});
    }
  }
  return tiles;
}

}  // namespace

struct ShadowScorer::Impl {
  PlanningScene scene;
  detail::DepthWeight weight;

  /// @throws Error bad_input for a view with another depth range: its weights would be others.
  void check(const PinholeCamera& view) const {
    if (view.range() == weight.range()) return;
    throw bad_input("views",
                    fmt::format("a view's depth range is {} to {} m; the scorer was made for {} to "
                                "{} m",
                                view.range().near_m, view.range().far_m, weight.range().near_m,
                                weight.range().far_m));
  }

  /// Calls `use(tiles, hits)` for batches of the tiles until it returns false.
  template <class Use>
  void trace(const PinholeCamera& view, std::span<const PixelTile> tiles, const Use& use) const {
    std::array<TileHits, kBatchTiles> hits;
    while (!tiles.empty()) {
      const auto batch = tiles.first(std::min(tiles.size(), kBatchTiles));
      const std::span batch_hits(hits.data(), batch.size());
      scene.surfaces().first_hits(view, batch, batch_hits);
      if (!use(batch, std::span<const TileHits>(batch_hits))) return;
      tiles = tiles.subspan(batch.size());
    }
  }

  ScoreBound score(const PinholeCamera& view, Score, const StopToken& stop) const {
    const std::vector<PixelTile> tiles = all_tiles(view.intrinsics());
    ScoreBound result{ScoreBound::Known::exact, 0};
    trace(view, tiles, [&](std::span<const PixelTile> batch, std::span<const TileHits> hits) {
      if (stop.stop_requested()) result = {};
      if (!result.exact()) return false;
      result.score += weight.sum(view.intrinsics(), scene.shadow_object(), batch, hits);
      return true;
    });
    return result;
  }
};

ShadowScorer::ShadowScorer(const PlanningScene& scene, const DepthRange& range, double depth_power)
    : impl_(new Impl{scene, detail::DepthWeight(depth_power, range)}) {}

ShadowScorer::~ShadowScorer() = default;

double ShadowScorer::unit() const noexcept {
  return impl_->weight.unit();
}

Score ShadowScorer::upper_bound(const PinholeCamera& view) const {
  impl_->check(view);
  const Intrinsics& image = view.intrinsics();
  return Score(image.width) * Score(image.height) * Score(detail::DepthWeight::kOne);
}

void ShadowScorer::score(std::span<const PinholeCamera> views, std::span<const Score> needed,
                         std::span<ScoreBound> results, const StopToken& stop) const {
  if (needed.size() != views.size() || results.size() != views.size()) {
    throw bad_input("views", fmt::format("{} views, {} scores needed and {} results; expected as "
                                         "many of each",
                                         views.size(), needed.size(), results.size()));
  }
  for (const PinholeCamera& view : views) {
    if (view.range() == impl_->weight.range()) continue;
    throw bad_input(
        "views", fmt::format("a view's depth range is {} to {} m; the scorer was made for {} to "
                             "{} m",
                             view.range().near_m, view.range().far_m, impl_->weight.range().near_m,
                             impl_->weight.range().far_m));
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    results[i] = stop.stop_requested() ? ScoreBound{} : impl_->score(views[i], needed[i], stop);
  }
}

std::vector<ScoreTerm> ShadowScorer::terms(const PinholeCamera& view) const {
  impl_->check(view);
  const Intrinsics& image = view.intrinsics();
  const ObjectId shadow = impl_->scene.shadow_object();
  Score sum = 0, pixels = 0;
  double depths_m = 0;
  impl_->trace(view, all_tiles(image),
               [&](std::span<const PixelTile> tiles, std::span<const TileHits> hits) {
                 sum += impl_->weight.sum(image, shadow, tiles, hits);
                 for (std::size_t i = 0; i < tiles.size(); ++i) {
                   unsigned shown =
                       detail::shadow_pixels(image, view.range(), shadow, tiles[i], hits[i]);
                   pixels += Score(std::popcount(shown));
                   for (; shown != 0; shown &= shown - 1) {
                     depths_m += double(hits[i].t[std::countr_zero(shown)]);
                   }
                 }
                 return true;
               });
  const double image_pixels = double(image.width) * double(image.height);
  return {{"shadow pixels", double(pixels)},
          {"share of the image", double(pixels) / image_pixels},
          {"mean depth", pixels == 0 ? 0 : depths_m / double(pixels), "m"},
          {"score", double(sum) * unit(), unit_name()}};
}

std::optional<ShadowBounds> ShadowScorer::shadow_bounds(const PinholeCamera& view) const {
  const Intrinsics& image = view.intrinsics();
  ShadowBounds bounds{image.width, -1, image.height, -1};
  impl_->trace(view, all_tiles(image),
               [&](std::span<const PixelTile> tiles, std::span<const TileHits> hits) {
                 for (std::size_t i = 0; i < tiles.size(); ++i) {
                   unsigned shown = detail::shadow_pixels(
                       image, view.range(), impl_->scene.shadow_object(), tiles[i], hits[i]);
                   for (; shown != 0; shown &= shown - 1) {
                     const int lane = std::countr_zero(shown);
                     const int u = 4 * tiles[i].column + lane % 4, v = 4 * tiles[i].row + lane / 4;
                     bounds = {std::min(bounds.left, u), std::max(bounds.right, u),
                               std::min(bounds.top, v), std::max(bounds.bottom, v)};
                   }
                 }
                 return true;
               });
  if (bounds.right < 0) return std::nullopt;
  return bounds;
}

}  // namespace vantage
