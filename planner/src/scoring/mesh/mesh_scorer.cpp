#include "vantage/planner/advanced/mesh_scorer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <iterator>
#include <optional>

#include "scene/scale_intrinsics.hpp"
#include "scene/tile_bounds.hpp"
#include "scoring/mesh/mesh_pixels.hpp"
#include "scoring/mesh/unseen_cells.hpp"
#include "scoring/shadow/depth_weight.hpp"
#include "vantage/raycore/advanced/unobserved_space.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "vantage/volume/advanced/shadow_filter.hpp"

namespace vantage {
namespace {

using planner::detail::MeshPixels;
using planner::detail::MeshTiles;
using planner::detail::UnseenTiles;

constexpr std::size_t kBatchTiles = 32;  // between two looks at `stop`, and at the bound
constexpr float kShadowFacing = 0.5f;    // v up to which a surface is shadow to the servo

/// What may be unseen: nothing is outside of it.
std::optional<TriangleMesh> shell_of(const SeenWorld& world) {
  return world.opened ? std::optional(shell_around_shadow(*world.opened)) : std::nullopt;
}

/// Puts the tiles with a pixel that meets the unseen first.
/// @returns how many they are.
std::size_t keep_unseen(std::span<PixelTile> tiles, std::span<UnseenHits> hits) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    const bool any = std::any_of(std::begin(hits[i].t), std::end(hits[i].t),
                                 [](float t) { return std::isfinite(t); });
    if (!any) continue;
    tiles[kept] = tiles[i];
    if (kept != i) hits[kept] = hits[i];
    ++kept;
  }
  return kept;
}

}  // namespace

struct MeshScorer::Impl {
  planner::detail::UnseenCells cells;
  UnobservedSpace seen;
  std::shared_ptr<const Scene> known;
  planner::detail::DepthWeight weight;  ///< of volumes, that of their far end
  bool by_volume;
  int image_width;

  /// @throws Error bad_input for a view with another depth range: its weights would be others.
  void check(const PinholeCamera& view) const {
    if (view.range() == weight.range()) return;
    throw bad_input(
        "views",
        fmt::format("a view has the depth range {} to {} m; expected the scorer's, {} to {} m",
                    view.range().near_m, view.range().far_m, weight.range().near_m,
                    weight.range().far_m));
  }

  /// The view on the image that it is scored by.
  PinholeCamera scored(const PinholeCamera& view) const {
    check(view);
    if (view.intrinsics().width == image_width) return view;
    return {planner::detail::scaled(view.intrinsics(), image_width), view.T_world_cam(),
            view.range()};
  }

  MeshPixels pixels(const PinholeCamera& view) const {
    return {view.intrinsics(), view.range(), weight.power()};
  }

  Score sum(const PinholeCamera& view, const MeshPixels& rule, const MeshTiles& tiles) const {
    return by_volume ? planner::detail::unseen_volume(view, tiles) : rule.sum(tiles);
  }

  /// Traces the tiles that may show what is unseen, batch by batch; `visit` gets those of a batch
  /// that do and how many tiles are left, and says whether to go on.
  template <class Visit>
  void trace(const PinholeCamera& view, const UnseenTiles& shown, const Visit& visit) const {
    std::array<PixelTile, kBatchTiles> tiles;
    std::array<UnseenHits, kBatchTiles> unseen;
    std::array<TileHits, kBatchTiles> objects;
    for (std::size_t next = 0; next < shown.tiles.size();) {
      const std::size_t count = std::min(kBatchTiles, shown.tiles.size() - next);
      std::copy_n(shown.tiles.begin() + std::ptrdiff_t(next), count, tiles.begin());
      next += count;
      seen.first_unseen(view, {tiles.data(), count}, {unseen.data(), count});
      const std::size_t kept = keep_unseen({tiles.data(), count}, {unseen.data(), count});
      const MeshTiles batch{{tiles.data(), kept}, {unseen.data(), kept}, {objects.data(), kept}};
      known->first_hits(view, batch.tiles, {objects.data(), kept});
      if (!visit(batch, shown.tiles.size() - next)) return;
    }
  }

  ScoreBound score(const PinholeCamera& given, Score needed, const StopToken& stop) const {
    const PinholeCamera view = scored(given);
    const MeshPixels rule = pixels(view);
    const UnseenTiles shown = cells.tiles(view);
    const Score most = PixelTile::kPixels * rule.most(shown.farthest_m);
    Score sum = 0, left = shown.tiles.size() * most;
    bool stopped = false;
    if (left >= needed) {
      trace(view, shown, [&](const MeshTiles& batch, std::size_t tiles_left) {
        sum += this->sum(view, rule, batch);
        left = tiles_left * most;
        stopped = left > 0 && stop.stop_requested();
        return !stopped && sum + left >= needed;
      });
    }
    if (stopped) return {};
    return {left == 0 ? ScoreBound::Known::exact : ScoreBound::Known::at_most, sum + left};
  }
};

MeshScorer::MeshScorer(const SeenWorld& world, const DepthRange& range, double depth_power,
                       int image_width, MeshWeight weight) {
  MeshMethod{.image_width = image_width}.check();
  const std::optional<TriangleMesh> shell = shell_of(world);
  const bool by_volume = weight == MeshWeight::volume;
  impl_.reset(new Impl{planner::detail::UnseenCells(world),
                       {world.lattices, world.work_area, shell ? &*shell : nullptr},
                       known_scene(world.known),
                       planner::detail::DepthWeight(by_volume ? 3 : depth_power, range),
                       by_volume,
                       image_width});
}

MeshScorer::~MeshScorer() = default;

double MeshScorer::unit() const noexcept {
  return impl_->weight.unit();
}

std::string_view MeshScorer::unit_name() const noexcept {
  return impl_->by_volume ? "m³ · pixels" : "m^power · pixels";
}

Score MeshScorer::upper_bound(const PinholeCamera& view) const {
  const PinholeCamera image = impl_->scored(view);
  const UnseenTiles shown = impl_->cells.tiles(image);
  return shown.tiles.size() * PixelTile::kPixels * impl_->pixels(image).most(shown.farthest_m);
}

void MeshScorer::score(std::span<const PinholeCamera> views, std::span<const Score> needed,
                       std::span<ScoreBound> results, const StopToken& stop) const {
  if (needed.size() != views.size() || results.size() != views.size()) {
    throw bad_input("views", fmt::format("{} views, {} scores needed and {} results; expected as "
                                         "many of each",
                                         views.size(), needed.size(), results.size()));
  }
  for (std::size_t i = 0; i < views.size(); ++i) {
    results[i] = stop.stop_requested() ? ScoreBound{} : impl_->score(views[i], needed[i], stop);
  }
}

std::vector<ScoreTerm> MeshScorer::terms(const PinholeCamera& given) const {
  const PinholeCamera view = impl_->scored(given);
  const MeshPixels rule = impl_->pixels(view);
  Score sum = 0;
  double pixels = 0, depths_m = 0, facing = 0;
  impl_->trace(view, impl_->cells.tiles(view), [&](const MeshTiles& batch, std::size_t) {
    sum += impl_->sum(view, rule, batch);
    for (std::size_t i = 0; i < batch.tiles.size(); ++i) {
      for (unsigned shown = rule.shown(batch, i, 1); shown != 0; shown &= shown - 1) {
        const int pixel = std::countr_zero(shown);
        pixels += 1;
        depths_m += double(batch.unseen[i].t[pixel]);
        facing += double(batch.unseen[i].facing[pixel]);
      }
    }
    return true;
  });
  const double image = double(view.intrinsics().width) * double(view.intrinsics().height);
  const double per_pixel = pixels == 0 ? 0 : 1 / pixels;
  return {{"unseen pixels", pixels},
          {"share of the image", pixels / image},
          {"mean depth", depths_m * per_pixel, "m"},
          {"mean shadowness v", facing * per_pixel},
          {"score", double(sum) * unit(), unit_name()}};
}

std::optional<ShadowBounds> MeshScorer::shadow_bounds(const PinholeCamera& view) const {
  return observe(view, std::nullopt).bounds;
}

ShadowObservation MeshScorer::observe(const PinholeCamera& view,
                                      const std::optional<ExtremePoints>& /*expected*/) const {
  impl_->check(view);
  const Intrinsics& k = view.intrinsics();
  const MeshPixels rule = impl_->pixels(view);
  ShadowBounds bounds{k.width, -1, k.height, -1};
  Score sum = 0;
  impl_->trace(view, impl_->cells.tiles(view), [&](const MeshTiles& batch, std::size_t) {
    sum += impl_->sum(view, rule, batch);
    for (std::size_t i = 0; i < batch.tiles.size(); ++i) {
      const unsigned shown = rule.shown(batch, i, kShadowFacing);
      if (shown != 0)
        bounds = planner::detail::joined(bounds, planner::detail::bounds_of(batch.tiles[i], shown));
    }
    return true;
  });
  ShadowObservation observation;
  if (bounds.right >= 0) observation.bounds = bounds;
  if (k.width == impl_->image_width) observation.score = sum;
  return observation;
}

}  // namespace vantage
