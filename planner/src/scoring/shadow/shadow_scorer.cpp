#include "vantage/planner/advanced/shadow_scorer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>

#include "scoring/shadow/depth_weight.hpp"
#include "scoring/shadow/masked_rasterizer.hpp"
#include "scoring/shadow/shadow_border.hpp"
#include "scoring/shadow/shadow_in_view.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

using planner::detail::ShadowInView;
using planner::detail::ViewCover;

// Blocks between two looks at `stop`: four thousand rays at most.
constexpr std::size_t kBlocksPerLook = 8;

/// A block of the image that may show shadow.
struct BoundedBlock {
  std::size_t block;
  Score bound;
};

std::vector<BoundedBlock> bounded_blocks(const ViewCover& cover) {
  std::vector<BoundedBlock> blocks;
  blocks.reserve(cover.block_count());
  for (std::size_t i = 0; i < cover.block_count(); ++i) {
    if (const Score bound = cover.bound(i); bound > 0) blocks.push_back({i, bound});
  }
  return blocks;
}

constexpr Score kNoBound = std::numeric_limits<Score>::max();
constexpr double kRounding = 1 + 1e-4;  // of weights, which are computed in float

/// How many pixels of the image may show a face of the groups, at most: counted in squares, 64 to
/// the longer side of the image.
double pixels_of(const std::vector<planner::detail::FaceProjector::GroupInView>& groups,
                 const Intrinsics& image) {
  constexpr int kSquares = 64;
  const int side = (std::max(image.width, image.height) + kSquares - 1) / kSquares;
  std::array<std::uint64_t, kSquares> rows{};
  for (const auto& group : groups) {
    const int first = group.columns.first / side, last = group.columns.last / side;
    const std::uint64_t squares = ~std::uint64_t(0) >> (kSquares - 1 - (last - first)) << first;
    for (int row = group.rows.first / side; row <= group.rows.last / side; ++row) {
      rows[std::size_t(row)] |= squares;
    }
  }
  int count = 0;
  for (const std::uint64_t row : rows) count += std::popcount(row);
  return double(count) * side * side;
}

Score sum_of(const std::vector<BoundedBlock>& blocks) {
  Score sum = 0;
  for (const BoundedBlock& block : blocks) sum += block.bound;
  return sum;
}

}  // namespace

struct ShadowScorer::Impl {
  PlanningScene scene;
  planner::detail::ShadowFaces faces;
  planner::detail::DepthWeight weight;

  /// @throws Error bad_input for a view with another depth range: its weights would be others.
  void check(const PinholeCamera& view) const {
    if (view.range() == weight.range()) return;
    throw bad_input(
        "views",
        fmt::format("a view has the depth range {} to {} m; expected the scorer's, {} to {} m",
                    view.range().near_m, view.range().far_m, weight.range().near_m,
                    weight.range().far_m));
  }

  /// As if all that the groups' rectangles may show were as far away as any shadow.
  Score rough_bound(const PinholeCamera& view, const planner::detail::FaceProjector& shadow) const {
    if (planner::detail::too_uncertain(shadow, view) || shadow.may_be_grazing()) return kNoBound;
    const double pixels = pixels_of(shadow.groups(), view.intrinsics());
    return Score(pixels * (double(weight.bound(shadow.farthest_m()).uncertain) * kRounding + 1));
  }

  /// What the view may show of the shadow; nothing if it certainly shows none.
  std::optional<ViewCover> bounded_cover(const PinholeCamera& view) const {
    planner::detail::FaceProjector projector =
        planner::detail::project_shadow(view, faces, scene.grid());
    return bounded_cover(view, projector);
  }

  std::optional<ViewCover> bounded_cover(const PinholeCamera& view,
                                         planner::detail::FaceProjector& projector) const {
    const ShadowInView shadow(view, faces, projector);
    if (shadow.shadow_count == 0) return std::nullopt;
    const planner::detail::WeightBound bound = weight.bound(shadow.farthest_m);
    ViewCover cover(shadow.columns, shadow.rows);
    for (const std::uint32_t i : shadow.order) {
      const planner::detail::FacePolygon& polygon = shadow.polygons[i];
      i < shadow.shadow_count ? cover.draw(polygon, bound) : cover.draw_occluder(polygon);
    }
    return cover;
  }

  ScoreBound score(const PinholeCamera& view, Score needed, const StopToken& stop) const {
    const std::optional<ViewCover> cover = bounded_cover(view);
    if (!cover) return {ScoreBound::Known::exact, 0};
    std::vector<BoundedBlock> blocks = bounded_blocks(*cover);
    Score at_most = sum_of(blocks);
    if (at_most < needed) return {ScoreBound::Known::at_most, at_most};
    // What is large is soon known to be less; with all of them needed anyway, the order is no use.
    if (needed > 0) {
      std::sort(blocks.begin(), blocks.end(), [](const BoundedBlock& a, const BoundedBlock& b) {
        return a.bound != b.bound ? a.bound > b.bound : a.block < b.block;
      });
    }
    std::array<PixelTile, 32> room;
    std::array<TileHits, 32> hits;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (i % kBlocksPerLook == 0 && stop.stop_requested()) return {};
      const std::span<const PixelTile> tiles = cover->tiles(blocks[i].block, room);
      const std::span block_hits(hits.data(), tiles.size());
      scene.surfaces().first_hits(view, tiles, block_hits);
      at_most -= blocks[i].bound;
      at_most += weight.sum(view.intrinsics(), scene.shadow_object(), tiles, block_hits);
      if (at_most < needed) return {ScoreBound::Known::at_most, at_most};
    }
    return {ScoreBound::Known::exact, at_most};
  }
};

ShadowScorer::ShadowScorer(const PlanningScene& scene, const DepthRange& range, double depth_power)
    : impl_(new Impl{scene, planner::detail::ShadowFaces(scene),
                     planner::detail::DepthWeight(depth_power, range)}) {}

ShadowScorer::~ShadowScorer() = default;

double ShadowScorer::unit() const noexcept {
  return impl_->weight.unit();
}

Score ShadowScorer::upper_bound(const PinholeCamera& view) const {
  return upper_bound_if_needed(view, 0);
}

Score ShadowScorer::upper_bound_if_needed(const PinholeCamera& view, Score needed) const {
  impl_->check(view);
  planner::detail::FaceProjector shadow =
      planner::detail::project_shadow(view, impl_->faces, impl_->scene.grid());
  if (needed > 0) {
    const Score rough = impl_->rough_bound(view, shadow);
    if (rough < needed) return rough;
  }
  const std::optional<ViewCover> cover = impl_->bounded_cover(view, shadow);
  return cover ? sum_of(bounded_blocks(*cover)) : 0;
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
        "views",
        fmt::format("a view has the depth range {} to {} m; expected the scorer's, {} to {} m",
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
  std::array<PixelTile, 32> room;
  std::array<TileHits, 32> hits;
  const std::optional<ViewCover> cover = impl_->bounded_cover(view);
  for (std::size_t block = 0; cover && block < cover->block_count(); ++block) {
    const std::span<const PixelTile> tiles = cover->tiles(block, room);
    const std::span block_hits(hits.data(), tiles.size());
    impl_->scene.surfaces().first_hits(view, tiles, block_hits);
    sum += impl_->weight.sum(image, shadow, tiles, block_hits);
    for (std::size_t i = 0; i < tiles.size(); ++i) {
      unsigned shown =
          planner::detail::shadow_pixels(image, view.range(), shadow, tiles[i], hits[i]);
      pixels += Score(std::popcount(shown));
      for (; shown != 0; shown &= shown - 1) depths_m += double(hits[i].t[std::countr_zero(shown)]);
    }
  }
  const double image_pixels = double(image.width) * double(image.height);
  return {{"shadow pixels", double(pixels)},
          {"share of the image", double(pixels) / image_pixels},
          {"mean depth", pixels == 0 ? 0 : depths_m / double(pixels), "m"},
          {"score", double(sum) * unit(), unit_name()}};
}

std::optional<ShadowBounds> ShadowScorer::shadow_bounds(const PinholeCamera& view) const {
  return observe(view, std::nullopt).bounds;
}

ShadowObservation ShadowScorer::observe(const PinholeCamera& view,
                                        const std::optional<ExtremePoints>& expected) const {
  return planner::detail::find_shadow_border(impl_->scene, view, impl_->faces, expected);
}

}  // namespace vantage
