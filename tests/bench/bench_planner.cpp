// The voxel method: what packets, shared rays and exact bounds are worth, each against the way
// without it, in turns; rows of the shadow method are in bench_planner_shadow.cpp.
//
// A row's time is the fast way's, in processor time of one thread unless it says otherwise, and
// `times_faster` the median of the ratio of the two.

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <string>
#include <vector>

#include "bench_planner_rays.hpp"
#include "bench_planner_scenes.hpp"
#include "reference/plain_views.hpp"
#include "timing.hpp"
#include "vantage/planner/advanced/view_search.hpp"
#include "vantage/planner/advanced/voxel_scorer.hpp"
#include "vantage/planner/plan.hpp"

namespace vantage::bench {
namespace {

/// A scene with its full set of views, those of one position together, and a sample of them that
/// slow ways are measured on.
struct Fixture {
  PlannerScene scene;
  std::shared_ptr<const VoxelScorer> scorer = std::make_shared<const VoxelScorer>(scene.scene);
  std::vector<ViewCandidate> candidates = view_candidates(full_views(), scene.area);
  std::vector<PinholeCamera> views = scene.views(full_views());
  std::vector<std::vector<PinholeCamera>> places = sites(views);
  std::vector<PinholeCamera> sample;
  test::PlainList list{scene.grid->centres(VoxelState::occupied),
                       scene.grid->geometry().voxel_size_m()};
  std::vector<std::vector<Score>> exact;  ///< by place

  explicit Fixture(PlannerScene s) : scene(std::move(s)) {
    for (std::size_t i = 0; i < views.size(); i += 1201) sample.push_back(views[i]);
    for (const auto& place : places) exact.push_back(scores(place));
  }

  std::vector<Score> scores(const std::vector<PinholeCamera>& place) const {
    const std::vector<Score> needed(place.size(), 0);
    std::vector<ScoreBound> results(place.size());
    scorer->score(place, needed, results);
    std::vector<Score> found;
    for (const ScoreBound& result : results) found.push_back(result.score);
    return found;
  }

  double per_view() const { return double(views.size()) / double(sample.size()); }
};
using Shared = std::shared_ptr<const Fixture>;

/// Measures `fast` against `slow` in turns; `slow` does a part of the work: its time counts
/// `slow_times`.
void compare(benchmark::State& state, const Work& fast, const Work& slow, double slow_times) {
  tbb::task_arena one(1);
  std::vector<double> ratios, slow_seconds;
  one.execute([&] {
    fast();
    for (auto _ : state) {
      const double fast_s = thread_seconds(fast), slow_s = slow_times * thread_seconds(slow);
      state.SetIterationTime(fast_s);
      ratios.push_back(slow_s / fast_s), slow_seconds.push_back(slow_s);
    }
  });
  state.counters["times_faster"] = median(ratios);
  state.counters["slow_ms"] = 1000 * median(slow_seconds);
}

void add(const std::string& name, const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond)
      ->Iterations(5);
}

Score best_of(const std::vector<Score>& scores) {
  return *std::max_element(scores.begin(), scores.end());
}

// --- the ways ---

Score sample_by_list(const Fixture& f) {
  Score best = 0;
  for (const PinholeCamera& view : f.sample) {
    best = std::max(best, f.list.score(f.scene.scene.shadow_centres(), view));
  }
  return best;
}

Score sample_by_single_rays(const Fixture& f) {
  return best_of(
      test::plain_scores(f.scene.scene.shadow_centres(), f.scene.scene.occluders(), f.sample));
}

Score sample_by_packets(const Fixture& f) {
  Score best = 0;
  for (const PinholeCamera& view : f.sample) {
    best = std::max(best, f.scorer->ViewScorer::score(view).score);
  }
  return best;
}

Score all_shared(const Fixture& f) {
  Score best = 0;
  for (const auto& place : f.places) {
    best = std::max(best, best_of(f.scores(place)));
  }
  return best;
}

/// What every view needs is its own score: bounds are kept, and no view is ever out.
void all_shared_with_bounds_in_vain(const Fixture& f) {
  std::vector<ScoreBound> results;
  for (std::size_t i = 0; i < f.places.size(); ++i) {
    results.resize(f.places[i].size());
    f.scorer->score(f.places[i], f.exact[i], results);
  }
}

/// Places strewn over the set; a view matters if it beats the best before it.
Score best_by_bounds(const Fixture& f) {
  Score best = 0;
  std::vector<ScoreBound> results;
  for (std::size_t i = 0; i < f.places.size(); ++i) {
    const auto& place = f.places[i * 845 % f.places.size()];
    const std::vector<Score> needed(place.size(), best + 1);
    results.resize(place.size());
    f.scorer->score(place, needed, results);
    for (const ScoreBound& result : results) {
      if (result.exact()) best = std::max(best, result.score);
    }
  }
  return best;
}

SearchResult search(const Fixture& f) {
  const auto checker = std::make_shared<const ViewValidityChecker>(ViewConstraints(), f.scene.scene,
                                                                   f.scene.camera.range());
  return ViewSearch(f.scorer, checker, nullptr, f.scene.camera, {}).run(f.candidates);
}

Plan plan(const Fixture& f, const CandidateSet& set, int servo_iterations) {
  PlanRequest request{.work_area = f.scene.area, .intrinsics = f.scene.camera.intrinsics()};
  request.range = f.scene.camera.range();
  request.voxel_size_m = f.scene.grid->geometry().voxel_size_m();
  request.value = ViewValue::bound;
  request.candidates = set;
  request.servo.iterations = servo_iterations;
  return plan_next_view(f.scene.world, f.scene.grid, request);
}

// --- the rows ---

/// In the thesis' terms: what hides is voxels.
void add_against_list(const Shared& f) {
  const std::string name = "voxel/" + f->scene.name + "/";
  add(name + "per view: packets against the plain list", [=](benchmark::State& state) {
    compare(
        state, [=] { sample_by_packets(*f); }, [=] { sample_by_list(*f); }, 1);
    if (sample_by_packets(*f) != sample_by_list(*f)) state.SkipWithError("scores differ");
  });
  add(name + "full set: shared rays against the plain list", [=](benchmark::State& state) {
    compare(
        state, [=] { all_shared(*f); }, [=] { sample_by_list(*f); }, f->per_view());
  });
}

void add_ways(const Shared& f) {
  const std::string name = "voxel/" + f->scene.name + "/";
  add(name + "per view: packets against single rays", [=](benchmark::State& state) {
    compare(
        state, [=] { sample_by_packets(*f); }, [=] { sample_by_single_rays(*f); }, 1);
    if (sample_by_packets(*f) != sample_by_single_rays(*f)) state.SkipWithError("scores differ");
  });
  add(name + "full set: shared rays against packets per view", [=](benchmark::State& state) {
    compare(
        state, [=] { all_shared(*f); }, [=] { sample_by_packets(*f); }, f->per_view());
  });
  add(name + "full set: bounds against shared rays alone", [=](benchmark::State& state) {
    compare(
        state, [=] { best_by_bounds(*f); }, [=] { all_shared(*f); }, 1);
    if (best_by_bounds(*f) != all_shared(*f)) state.SkipWithError("the best scores differ");
  });
  add(name + "full set: bounds in vain against no bounds", [=](benchmark::State& state) {
    compare(
        state, [=] { all_shared_with_bounds_in_vain(*f); }, [=] { all_shared(*f); }, 1);
  });
  add(name + "full set: search for the top ten against shared rays", [=](benchmark::State& state) {
    compare(
        state, [=] { search(*f); }, [=] { all_shared(*f); }, 1);
  });
}

/// Wall time on two threads, from a classified grid to the plan.
void add_plans(const Shared& f) {
  const auto add_plan = [&](const char* what, const CandidateSet& set, int servo) {
    add("voxel/" + f->scene.name + "/" + what, [=](benchmark::State& state) {
      tbb::task_arena two(2);
      for (auto _ : state) {
        state.SetIterationTime(wall_seconds([&] { two.execute([&] { plan(*f, set, servo); }); }));
      }
    });
  };
  add_plan("plan: production set, servo 5, two threads", production_views(), 5);
  add_plan("plan: full set, two threads", full_views(), 0);
  add_plan("plan: full set, servo 5, two threads", full_views(), 5);
}

/// Fine enough for some 900 shadow voxels and more.
PlannerScene make_scene(const std::string& name, OccluderMode mode) {
  if (name == "wall") return wall_scene(0.005, mode);
  if (name == "two pillars") return two_pillars_scene(kThesisVoxel, mode);
  return corridor_scene(kThesisVoxel, mode);
}

void add_voxel_rows() {
  for (const char* name : {"wall", "two pillars", "corridor"}) {
    add_against_list(std::make_shared<Fixture>(make_scene(name, OccluderMode::voxels)));
    const auto meshes = std::make_shared<Fixture>(make_scene(name, OccluderMode::mesh));
    add_ways(meshes);
    add_plans(meshes);
  }
}

}  // namespace
}  // namespace vantage::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  vantage::bench::add_voxel_rows();
  vantage::bench::add_ray_rows();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
