#include "vantage/planner/light_scorer.hpp"

#include "scoring/voxel/surface_samples.hpp"
#include "vantage/volume/classify.hpp"

namespace vantage {
namespace {

/// The samples that no camera sees.
VisiblePoints in_the_dark(const Points& samples, const WorldModel& world) {
  const std::shared_ptr<const Scene> known = known_scene(world);
  const VisiblePoints all(samples, known);
  std::vector<std::uint8_t> lit(samples.size());
  for (const Observer& lamp : world.cameras) {
    const std::vector<std::uint8_t> seen = all.visible(lamp.camera);
    for (std::size_t i = 0; i < lit.size(); ++i) lit[i] |= seen[i];
  }
  Points dark;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    if (lit[i] == 0) dark.push_back(samples[i]);
  }
  return {std::move(dark), known};
}

}  // namespace

LightScorer::LightScorer(const PlanningScene& scene, const WorldModel& world)
    : LightScorer(detail::surface_samples(world, scene.grid().geometry().box()), world) {}

// What faces away needs no test of its own: the surface itself lies between, as it does for a lamp.
LightScorer::LightScorer(const detail::SurfaceSamples& samples, const WorldModel& world)
    : area_per_point_m2_(samples.area_per_point_m2), dark_(in_the_dark(samples.points, world)) {}

Score LightScorer::upper_bound(const PinholeCamera& view) const {
  return dark_.upper_bound(view);
}

void LightScorer::score(std::span<const PinholeCamera> views, std::span<const Score> needed,
                        std::span<ScoreBound> results, const StopToken& stop) const {
  dark_.count(views, needed, results, stop);
}

std::vector<ScoreTerm> LightScorer::terms(const PinholeCamera& view) const {
  const double lit = double(score(view).score) * area_per_point_m2_;
  const double in_view = double(dark_.count_in_view(view)) * area_per_point_m2_;
  const double dark = double(dark_.size()) * area_per_point_m2_;
  return {{"dark surface out of view", dark - in_view, "m²"},
          {"dark surface in view", in_view, "m²"},
          {"dark surface hidden or facing away", in_view - lit, "m²"},
          {"dark surface lit", lit, "m²"}};
}

}  // namespace vantage
