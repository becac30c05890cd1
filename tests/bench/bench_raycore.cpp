// Rays per second of a Scene, and what a Scene costs over bare Embree calls with the same rays.
//
// A row's rate (items_per_second) is the Scene's. `bare/s` is the rate of the bare calls and
// `cost_over_bare` the median of the ratio of the two times, taken in turns.

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bare_embree.hpp"
#include "timing.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "workload.hpp"

namespace vantage::bench {
namespace {

/// Measures `ours` against `other`, taking turns in who goes first.
void compare(benchmark::State& state, std::size_t rays, const Work& ours, const Work& other,
             const char* ratio_name, const char* other_rate_name) {
  tbb::task_arena one(1);
  ours(), other();  // warm up
  std::vector<double> ratios, other_times;
  one.execute([&] {
    bool ours_first = true;
    for (auto _ : state) {
      double first = thread_seconds(ours_first ? ours : other);
      double second = thread_seconds(ours_first ? other : ours);
      if (!ours_first) std::swap(first, second);
      ours_first = !ours_first;
      state.SetIterationTime(first);
      ratios.push_back(first / second);
      other_times.push_back(second);
    }
  });
  state.SetItemsProcessed(state.iterations() * std::int64_t(rays));
  state.counters[ratio_name] = median(ratios);
  state.counters[other_rate_name] = double(rays) / median(other_times);
}

/// A workload with everything that its benchmarks share; lives as long as the program.
struct Fixture {
  Workload work;
  std::shared_ptr<const Scene> scene;
  BareScene bare_scene;
  BareScene fast_scene;  // without the robust flag
  BareRays bare_rays;
  std::vector<std::uint8_t> result, bare_result;
  Hits hits, bare_hits;

  explicit Fixture(Workload w)
      : work(std::move(w)),
        bare_scene(*work.scene),
        fast_scene(*work.scene, RTC_SCENE_FLAG_NONE),
        bare_rays(work),
        result(work.size()),
        bare_result(work.size()) {
    SceneBuilder builder;
    for (const TriangleMesh& mesh : *work.scene) builder.add_mesh(mesh);
    scene = builder.build();
    hits.resize(work.size()), bare_hits.resize(work.size());
  }

  RayOrder order(bool coherent) const {
    return coherent ? RayOrder::coherent : RayOrder::incoherent;
  }

  void occluded(bool coherent) {
    if (work.one_end) {
      scene->occluded(work.origins, work.ends[0], result, order(coherent));
    } else {
      scene->occluded(work.origins, work.ends, result, order(coherent));
    }
  }
  void closest_hits(bool coherent) {
    if (work.one_origin) {
      scene->closest_hits(work.origins[0], work.directions, hits, order(coherent));
    } else {
      scene->closest_hits(work.origins, work.directions, hits, order(coherent));
    }
  }
  void bare_occluded(const BareScene& bare, bool coherent) {
    bare_rays.occluded16(bare, bare_result.data(), coherent);
  }
  void bare_hits_of(const BareScene& bare, bool coherent) {
    bare_rays.intersect16(bare, bare_hits, coherent);
  }
  void occluded_single() {
    for (std::size_t i = 0; i < work.size(); ++i) {
      result[i] = scene->occluded(work.origins[i], work.ends[i]);
    }
  }
  void closest_hits_single() {
    for (std::size_t i = 0; i < work.size(); ++i) {
      const auto hit = scene->closest_hit({work.origins[i], work.directions[i]});
      hits.t[i] = hit ? hit->t : std::numeric_limits<float>::infinity();
    }
  }
};

void add(const std::string& name, const std::function<void(benchmark::State&)>& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)->UseManualTime()->Unit(benchmark::kMillisecond);
}

void add_against_bare(const std::string& name, const std::shared_ptr<Fixture>& f, const Work& ours,
                      const Work& bare) {
  add(name, [=](benchmark::State& state) {
    compare(state, f->work.size(), ours, bare, "cost_over_bare", "bare/s");
    if (f->result != f->bare_result) state.SkipWithError("occlusion differs from bare Embree");
    if (f->hits.t != f->bare_hits.t) state.SkipWithError("depths differ from bare Embree");
  });
}

void add_threads(const std::string& name, const std::shared_ptr<Fixture>& f, const Work& ours) {
  add(name, [=](benchmark::State& state) {
    tbb::task_arena two(2);
    two.execute([&] {
      for (auto _ : state) state.SetIterationTime(wall_seconds(ours));
    });
    state.SetItemsProcessed(state.iterations() * std::int64_t(f->work.size()));
  });
}

void add_batches(const std::shared_ptr<Fixture>& f) {
  const std::string& name = f->work.name;
  const bool coherent = f->work.coherent;
  add_against_bare(
      "occluded/batch/" + name, f, [=] { f->occluded(coherent); },
      [=] { f->bare_occluded(f->bare_scene, coherent); });
  add_against_bare(
      "closest_hit/batch/" + name, f, [=] { f->closest_hits(coherent); },
      [=] { f->bare_hits_of(f->bare_scene, coherent); });
}

void add_two_threads(const std::shared_ptr<Fixture>& f) {
  const bool coherent = f->work.coherent;
  add_threads("occluded/batch, 2 threads/" + f->work.name, f, [=] { f->occluded(coherent); });
  add_threads("closest_hit/batch, 2 threads/" + f->work.name, f,
              [=] { f->closest_hits(coherent); });
}

void add_single_rays(const std::shared_ptr<Fixture>& f) {
  const std::string& name = f->work.name;
  add_against_bare(
      "occluded/single/" + name, f, [=] { f->occluded_single(); },
      [=] { f->bare_rays.occluded1(f->bare_scene, f->bare_result.data()); });
  add_against_bare(
      "closest_hit/single/" + name, f, [=] { f->closest_hits_single(); },
      [=] { f->bare_rays.intersect1(f->bare_scene, f->bare_hits); });
}

/// What the choices that a Scene makes are worth.
void add_flags(const std::shared_ptr<Fixture>& f) {
  const bool coherent = f->work.coherent;
  const auto add_ratio = [&](const std::string& name, const Work& a, const Work& b,
                             const char* ratio) {
    add(name + "/" + f->work.name,
        [=](benchmark::State& state) { compare(state, f->work.size(), a, b, ratio, "other/s"); });
  };
  add_ratio(
      "occluded/coherent flag", [=] { f->occluded(true); }, [=] { f->occluded(false); },
      "time_over_incoherent");
  add_ratio(
      "closest_hit/coherent flag", [=] { f->closest_hits(true); }, [=] { f->closest_hits(false); },
      "time_over_incoherent");
  add_ratio(
      "occluded/robust flag", [=] { f->bare_occluded(f->bare_scene, coherent); },
      [=] { f->bare_occluded(f->fast_scene, coherent); }, "time_over_fast");
  add_ratio(
      "closest_hit/robust flag", [=] { f->bare_hits_of(f->bare_scene, coherent); },
      [=] { f->bare_hits_of(f->fast_scene, coherent); }, "time_over_fast");
}

void add_all(const Workload& work) {
  const auto f = std::make_shared<Fixture>(work);
  add_batches(f);
  add_batches(std::make_shared<Fixture>(in_cache(work)));
  add_two_threads(f);
  add_single_rays(f);
  add_flags(f);
}

}  // namespace
}  // namespace vantage::bench

int main(int argc, char** argv) {
  using namespace vantage::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  add_all(voxels_to_camera("cubes/voxels", five_cubes()));
  add_all(pixels("cubes/pixels", five_cubes()));
  add_all(voxels_to_camera("million/voxels", million_triangles()));
  add_all(pixels("million/pixels", million_triangles()));
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
