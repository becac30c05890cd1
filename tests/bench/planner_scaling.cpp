// How the voxel method's time grows with the candidates and with the shadow:
//   planner_scaling FILE.csv FILE.svg
// writes the figures, and draws them. Processor time of one thread, the best of three runs.

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "bench_planner_scenes.hpp"
#include "metrics/planning/planning_numbers.hpp"
#include "scaling_plot.hpp"
#include "timing.hpp"
#include "vantage/planner/advanced/view_search.hpp"
#include "vantage/planner/advanced/voxel_scorer.hpp"
#include "vantage/raycore/detail/file.hpp"

namespace vantage::bench {
namespace {

double best_of_three(const Work& work) {
  tbb::task_arena one(1);
  double best = 1e300;
  for (int i = 0; i < 3; ++i) {
    one.execute([&] { best = std::min(best, thread_seconds(work)); });
  }
  return best;
}

/// Every view's score, by shared rays.
double seconds_of_all(const VoxelScorer& scorer, const std::vector<PinholeCamera>& views) {
  const auto places = sites(views);
  return best_of_three([&] {
    for (const auto& place : places) {
      const std::vector<Score> needed(place.size(), 0);
      std::vector<ScoreBound> results(place.size());
      scorer.score(place, needed, results);
    }
  });
}

/// The ten best, by bounds, with everything that a search does.
double seconds_of_search(const PlannerScene& scene, std::shared_ptr<const VoxelScorer> scorer,
                         const CandidateSet& set) {
  const auto checker = std::make_shared<const ViewValidityChecker>(ViewConstraints(), scene.scene,
                                                                   scene.camera.range());
  const ViewSearch search(std::move(scorer), checker, nullptr, scene.camera, {});
  const std::vector<ViewCandidate> candidates = view_candidates(set, scene.area);
  return best_of_three([&] { search.run(candidates); });
}

void measure(const PlannerScene& scene, const HalfSpheres& set, double size, ScalingPanel& panel) {
  const auto scorer = std::make_shared<const VoxelScorer>(scene.scene);
  const double times[] = {seconds_of_all(*scorer, scene.views(set)),
                          seconds_of_search(scene, scorer, set)};
  for (std::size_t s = 0; s < 2; ++s) {
    panel.series[s].size.push_back(size);
    panel.series[s].seconds.push_back(times[s]);
  }
}

ScalingPanel over_candidates() {
  const PlannerScene scene = two_pillars_scene(kThesisVoxel, OccluderMode::mesh);
  ScalingPanel panel{count_text(scene.shadow_voxels()) + " shadow voxels",
                     "candidates, 25 at each position",
                     {{"every view's score", {}, {}}, {"search for the ten best", {}, {}}}};
  for (const int views : {50, 400, 3200, 34225, 200'000, 1'000'000}) {
    const int positions = views / 25;
    measure(scene, {.counts = {positions / 2, positions - positions / 2}, .fan = {.rings = 2}},
            double(views), panel);
  }
  return panel;
}

ScalingPanel over_shadow() {
  ScalingPanel panel{"1,000 candidates",
                     "shadow voxels",
                     {{"every view's score", {}, {}}, {"search for the ten best", {}, {}}}};
  for (const double voxel_size_m : {0.011, 0.005, 0.0024, 0.0011}) {
    const PlannerScene scene = two_pillars_scene(voxel_size_m, OccluderMode::mesh);
    measure(scene, {.counts = {20}, .fan = {.rings = 2}}, double(scene.shadow_voxels()), panel);
  }
  return panel;
}

std::string csv(const std::vector<ScalingPanel>& panels) {
  std::string text = "over,way,size,seconds,exponent\n";
  for (const ScalingPanel& panel : panels) {
    for (const ScalingSeries& series : panel.series) {
      for (std::size_t i = 0; i < series.size.size(); ++i) {
        text += fmt::format("\"{}\",{},{:.0f},{:.6g},{:.3f}\n", panel.x_label, series.name,
                            series.size[i], series.seconds[i], series.exponent());
      }
    }
  }
  return text;
}

void run(const std::string& csv_path, const std::string& svg_path) {
  const std::vector<ScalingPanel> panels = {over_candidates(), over_shadow()};
  const std::string figures = csv(panels);
  const std::string picture =
      scaling_plot_svg("Voxel method: time of one thread over the size of the problem", panels);
  write_file(csv_path, figures);
  write_file(svg_path, picture);
}

}  // namespace
}  // namespace vantage::bench

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: planner_scaling FILE.csv FILE.svg\n", stderr);
    return 2;
  }
  vantage::bench::run(argv[1], argv[2]);
  return 0;
}
