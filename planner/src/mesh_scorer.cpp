#include "vantage/planner/mesh_scorer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "depth_weight.hpp"
#include "mesh_pixels.hpp"
#include "small_image.hpp"
#include "tile_bounds.hpp"
#include "unseen_volume.hpp"
#include "vantage/raycore/box_projector.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/seen_space.hpp"
#include "vantage/volume/classify.hpp"
#include "vantage/volume/shadow_filter.hpp"

namespace vantage {
namespace {

using detail::MeshPixels;
using detail::MeshTiles;

constexpr std::size_t kBatchTiles = 32;  // between two looks at `stop`, and at the bound
constexpr float kShadowFacing = 0.5f;    // v up to which a surface is shadow to the servo

/// The tiles of an image that may show a box.
struct TileRange {
  int first_column = 0, last_column = -1, first_row = 0, last_row = -1;
  double farthest_m = 0;

  std::size_t columns() const { return std::size_t(last_column - first_column + 1); }
  std::size_t count() const { return columns() * std::size_t(last_row - first_row + 1); }
  PixelTile operator[](std::size_t i) const {
    return {std::uint16_t(std::size_t(first_column) + i % columns()),
            std::uint16_t(std::size_t(first_row) + i / columns())};
  }
};

TileRange tiles_of(const PinholeCamera& view, const Box& box) {
  const BoxProjector projector(view);
  const Extent extent{box.centre(), 0.5 * box.size()};
  const BoxInView shown = projector.project(extent, projector.margin_m(extent));
  if (shown.coverage == Coverage::none) return {};
  const auto tile = [](double pixel, int size) {
    return int(std::clamp(pixel, 0.0, double(size - 1))) / PixelTile::kSide;
  };
  const Intrinsics& k = view.intrinsics();
  return {tile(shown.rect.u0 - 0.5, k.width), tile(shown.rect.u1 + 1.5, k.width),
          tile(shown.rect.v0 - 0.5, k.height), tile(shown.rect.v1 + 1.5, k.height), shown.z_max};
}

/// What is unseen, less the false shadow.
SeenSpace seen_space(const SeenWorld& world) {
  if (world.opened == nullptr) return {world.lattices, world.work_area};
  const TriangleMesh shell = shell_around_shadow(*world.opened);
  return {world.lattices, world.work_area, &shell};
}

}  // namespace

struct MeshScorer::Impl {
  SeenSpace seen;
  std::shared_ptr<const Scene> known;
  detail::DepthWeight weight;  ///< of volumes, that of their far end
  bool by_volume;
  int image_width;

  /// @throws Error bad_input for a view with another depth range: its weights would be others.
  void check(const PinholeCamera& view) const {
    if (view.range() == weight.range()) return;
    throw bad_input("views",
                    fmt::format("a view's depth range is {} to {} m; the scorer was made for {} to "
                                "{} m",
                                view.range().near_m, view.range().far_m, weight.range().near_m,
                                weight.range().far_m));
  }

  /// The view on the image that it is scored by.
  PinholeCamera scored(const PinholeCamera& view) const {
    check(view);
    if (view.intrinsics().width == image_width) return view;
    return {detail::scaled(view.intrinsics(), image_width), view.T_world_cam(), view.range()};
  }

  MeshPixels pixels(const PinholeCamera& view) const {
    return {view.intrinsics(), view.range(), weight.power()};
  }

  Score sum(const PinholeCamera& view, const MeshPixels& rule, const MeshTiles& tiles) const {
    return by_volume ? detail::unseen_volume(view, tiles) : rule.sum(tiles);
  }

  /// Traces the tiles that may show the work area, batch by batch; `visit` gets each batch and how
  /// many tiles are left, and says whether to go on.
  template <class Visit>
  void trace(const PinholeCamera& view, const TileRange& range, const Visit& visit) const {
    std::array<PixelTile, kBatchTiles> tiles;
    std::array<UnseenHits, kBatchTiles> unseen;
    std::array<TileHits, kBatchTiles> objects;
    for (std::size_t next = 0; next < range.count();) {
      const std::size_t count = std::min(kBatchTiles, range.count() - next);
      for (std::size_t i = 0; i < count; ++i) tiles[i] = range[next++];
      const MeshTiles batch{{tiles.data(), count}, {unseen.data(), count}, {objects.data(), count}};
      seen.first_unseen(view, batch.tiles, {unseen.data(), count});
      known->first_hits(view, batch.tiles, {objects.data(), count});
      if (!visit(batch, range.count() - next)) return;
    }
  }

  ScoreBound score(const PinholeCamera& given, Score needed, const StopToken& stop) const {
    const PinholeCamera view = scored(given);
    const MeshPixels rule = pixels(view);
    const TileRange range = tiles_of(view, seen.box());
    const Score most = PixelTile::kPixels * rule.most(range.farthest_m);
    Score sum = 0, left = range.count() * most;
    bool stopped = false;
    if (left >= needed) {
      trace(view, range, [&](const MeshTiles& batch, std::size_t tiles_left) {
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
                       int image_width, MeshWeight weight)
    : impl_(new Impl{seen_space(world), known_scene(world.known),
                     detail::DepthWeight(weight == MeshWeight::volume ? 3 : depth_power, range),
                     weight == MeshWeight::volume, image_width}) {
  MeshOptions{.image_width = image_width}.check();
}

MeshScorer::~MeshScorer() = default;

double MeshScorer::unit() const noexcept {
  return impl_->weight.unit();
}

Score MeshScorer::upper_bound(const PinholeCamera& view) const {
  const PinholeCamera image = impl_->scored(view);
  const TileRange range = tiles_of(image, impl_->seen.box());
  return range.count() * PixelTile::kPixels * impl_->pixels(image).most(range.farthest_m);
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
  impl_->trace(view, tiles_of(view, impl_->seen.box()), [&](const MeshTiles& batch, std::size_t) {
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
  return look(view).bounds;
}

ShadowSight MeshScorer::look(const PinholeCamera& view) const {
  impl_->check(view);
  const Intrinsics& k = view.intrinsics();
  const MeshPixels rule = impl_->pixels(view);
  ShadowBounds bounds{k.width, -1, k.height, -1};
  Score sum = 0;
  impl_->trace(view, tiles_of(view, impl_->seen.box()), [&](const MeshTiles& batch, std::size_t) {
    sum += impl_->sum(view, rule, batch);
    for (std::size_t i = 0; i < batch.tiles.size(); ++i) {
      const unsigned shown = rule.shown(batch, i, kShadowFacing);
      if (shown != 0) bounds = detail::joined(bounds, detail::bounds_of(batch.tiles[i], shown));
    }
    return true;
  });
  ShadowSight sight;
  if (bounds.right >= 0) sight.bounds = bounds;
  if (k.width == impl_->image_width) sight.score = sum;
  return sight;
}

}  // namespace vantage
