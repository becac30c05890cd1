#include "vantage/planner/advanced/expected_scorer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scoring/expected/reading_rays.hpp"
#include "scoring/expected/unseen_model.hpp"
#include "scoring/voxel/shadow_points.hpp"
#include "vantage/planner/advanced/visible_points.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

using planner::detail::UnseenModel;

constexpr Score kCertain = 255;  // what a voxel counts that is certain to be revealed

// The interval: how far gains of simulated cells are from what was expected (`vantage evaluate
// expected-gain`). Doubt is p (1 - p), summed over the voxels, in whole ones.
constexpr double kOfGain = 0.25, kOfDoubt = 1.7, kVoxels = 14;

// Number of voxels in sight that are examined in detail, evenly spread over all of them; the others
// are taken to be alike. Their mean is right to two or three percent.
constexpr std::size_t kSamples = 384;

/// What a view is to gain, in 255ths of a voxel.
struct Sums {
  Score expected = 0;
  Score doubt = 0;  ///< p (255 - p), summed
};

/// Of `all` voxels in sight, some that are spread over them.
Points some_of(const VisibleMasks& seen, Score all, PointsView points) {
  Points some;
  some.reserve(kSamples);
  Score index = 0;
  seen.for_each([&](std::size_t point) {
    // The i-th is taken where i · samples / all reaches the next whole number.
    const Score before = index * kSamples / all, after = ++index * kSamples / all;
    if (all <= kSamples || after > before) some.push_back(points[point]);
  });
  return some;
}

Sums sums_of(const UnseenModel& model, const PinholeCamera& view, Score all, const Points& some) {
  Sums sums;
  for (const std::uint8_t p : planner::detail::reading_probabilities(model, view, some)) {
    sums.expected += p, sums.doubt += p * (kCertain - p);
  }
  sums.expected = sums.expected * all / some.size();
  sums.doubt = sums.doubt * all / some.size();
  return sums;
}

/// What has to be in sight for a score to be enough.
Score voxels_needed(Score needed) {
  return needed / kCertain + (needed % kCertain != 0 ? 1 : 0);
}

}  // namespace

void ExpectedGainOptions::check() const {
  sensor.check("movable camera's sensor");
  if (std::isfinite(unknown_depth) && unknown_depth >= 0) return;
  throw bad_input("unknown_depth",
                  fmt::format("is {}; expected a finite number, 0 or above", unknown_depth));
}

struct ExpectedScorer::Impl {
  double voxel_volume_m3;
  UnseenModel model;
  VisiblePoints points;

  Sums weigh(const PinholeCamera& view, Score all, const VisibleMasks& seen) const {
    return sums_of(model, view, all, some_of(seen, all, points.ordered_points()));
  }
};

namespace {

/// Surfaces are as thick as they are measured: what is within half of that behind the front of one
/// is measured as part of it. Measured voxels reach as far to the front again.
std::vector<Obstacles> obstacles_of(const PlanningScene& scene, const WorldModel& world,
                                    const VolumeOptions& volume, const UnseenModel& model) {
  if (model.ideal) return {{planner::detail::shared_occluders(scene)}};
  const SurfaceBand half{0.5 * model.voxel_m, model.half_band_1m};
  if (volume.occluders == OccluderMode::voxels)
    return {{planner::detail::shared_occluders(scene), half}};
  SceneBuilder measured;
  add_occluders({}, scene.grid(), volume.occluders, measured);
  const SurfaceBand all{2 * model.voxel_m, 2 * model.half_band_1m};
  return {{known_scene(world), half}, {measured.build(), all}};
}

}  // namespace

ExpectedScorer::ExpectedScorer(const PlanningScene& scene, const WorldModel& world,
                               const VolumeOptions& volume, const ExpectedGainOptions& options) {
  options.check();
  UnseenModel model(scene, world, volume, options);
  VisiblePoints points(planner::detail::shadow_points(scene),
                       obstacles_of(scene, world, volume, model));
  impl_ = std::make_unique<const Impl>(
      Impl{scene.grid().geometry().voxel_volume_m3(), std::move(model), std::move(points)});
}
ExpectedScorer::~ExpectedScorer() = default;

double ExpectedScorer::unit() const noexcept {
  return impl_->voxel_volume_m3 / double(kCertain);
}

Score ExpectedScorer::upper_bound(const PinholeCamera& view) const {
  return kCertain * impl_->points.upper_bound(view);
}

void ExpectedScorer::score(std::span<const PinholeCamera> views, std::span<const Score> needed,
                           std::span<ScoreBound> results, const StopToken& stop) const {
  std::vector<Score> voxels;
  for (const Score score : needed) voxels.push_back(voxels_needed(score));
  std::vector<VisibleMasks> seen(views.size());
  impl_->points.count(views, voxels, results, seen, stop);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const bool weigh = results[i].exact() && results[i].score > 0 && !impl_->model.certain();
    const Score voxels_in_sight = results[i].score;
    results[i].score *= kCertain;
    if (!weigh) continue;
    if (stop.stop_requested()) {
      results[i] = {};
    } else {
      results[i].score = impl_->weigh(views[i], voxels_in_sight, seen[i]).expected;
    }
  }
}

std::vector<ScoreTerm> ExpectedScorer::terms(const PinholeCamera& view) const {
  const GainEstimate gain = estimate(view);
  std::array<ScoreBound, 1> count;
  const std::array<Score, 1> needed{0};
  impl_->points.count({&view, 1}, needed, count, {});
  return {{"voxels in sight", double(count[0].score)},
          {"volume in sight", double(count[0].score) * impl_->voxel_volume_m3, "m³"},
          {"expected, at least", gain.low_m3, "m³"},
          {"expected, at most", gain.high_m3, "m³"},
          {"volume expected", gain.expected_m3, "m³"}};
}

GainEstimate ExpectedScorer::estimate(const PinholeCamera& view) const {
  std::array<ScoreBound, 1> count;
  const std::array<Score, 1> needed{0};
  std::array<VisibleMasks, 1> seen;
  impl_->points.count({&view, 1}, needed, count, seen, {});
  const double voxel_m3 = impl_->voxel_volume_m3, bound_m3 = double(count[0].score) * voxel_m3;
  if (count[0].score == 0 || impl_->model.certain()) return {bound_m3, bound_m3, bound_m3};
  const Sums sums = impl_->weigh(view, count[0].score, seen[0]);
  const double expected_m3 = double(sums.expected) * unit();
  const double doubt_m3 = double(sums.doubt) * voxel_m3 / double(kCertain * kCertain);
  const double spread_m3 = kOfGain * expected_m3 + kOfDoubt * doubt_m3 + kVoxels * voxel_m3;
  return {expected_m3, std::max(0.0, expected_m3 - spread_m3), expected_m3 + spread_m3};
}

}  // namespace vantage
