// From detected features to objects: nine cameras around five cubes, as in the thesis' Castle, and
// around twenty objects of five types with missing and wrong markers. Features are computed, not
// detected: detection takes its own time per image.

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <string>
#include <vector>

#include "reconstruction/synthetic_views.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

namespace vantage::bench {
namespace {

using Method = Reconstruction (*)(std::span<const CameraView>, const KnowledgeBase&,
                                  const ReconstructOptions&, const StopToken&);

struct Setting {
  MemoryKnowledgeBase knowledge;
  std::vector<test::PlacedObject> objects;
  std::vector<CameraView> views;

  std::size_t sightings() const {
    std::size_t sum = 0;
    for (const CameraView& view : views) sum += view.observations.size();
    return sum;
  }
};

MemoryKnowledgeBase five_cubes() {
  std::vector<ObjectType> types;
  for (const std::string name : {"red", "green", "blue", "purple", "yellow"}) {
    types.push_back(test::marked_box(name + " cube", {0.05, 0.05, 0.05}, 6 * int(types.size())));
  }
  return MemoryKnowledgeBase(std::move(types));
}

/// Three cubes in a row, two on top of them.
Setting castle() {
  Setting s{five_cubes(), {}, {}};
  const std::vector<Eigen::Vector3d> places{
      {-0.06, 0, 0.025}, {0, 0, 0.025}, {0.06, 0, 0.025}, {-0.03, 0, 0.075}, {0.03, 0, 0.075}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    s.objects.push_back({s.knowledge.types()[i], Pose::from_translation(places[i])});
  }
  test::Random random(1);
  s.views = test::cameras_around(random, 9);
  test::look_at(s.views, s.objects, {}, random);
  return s;
}

Setting clutter() {
  Setting s{five_cubes(), {}, {}};
  test::Random random(2);
  s.objects = test::scattered(random, s.knowledge.types(), 20, 0.25);
  s.views = test::cameras_around(random, 9);
  test::look_at(s.views, s.objects, {.missing = 0.2, .wrong_id = 0.05}, random);
  return s;
}

void run(benchmark::State& state, Method method, Setting (*make)()) {
  const Setting setting = make();
  const int threads = int(state.range(0));
  tbb::task_arena arena(threads);
  std::size_t objects = 0;
  for (auto _ : state) {
    arena.execute(
        [&] { objects = method(setting.views, setting.knowledge, {}, {}).objects.size(); });
  }
  state.counters["sightings"] = double(setting.sightings());
  state.counters["objects"] = double(objects);
}

void add(const char* name, Method method, Setting (*make)()) {
  benchmark::RegisterBenchmark(name, run, method, make)
      ->ArgName("threads")
      ->Arg(1)
      ->Arg(2)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime();
}

}  // namespace
}  // namespace vantage::bench

int main(int argc, char** argv) {
  using namespace vantage::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  add("castle/svd", vantage::reconstruct_svd, castle);
  add("castle/pnp", vantage::reconstruct_pnp, castle);
  add("castle/voting", vantage::reconstruct_voting, castle);
  add("clutter/svd", vantage::reconstruct_svd, clutter);
  add("clutter/pnp", vantage::reconstruct_pnp, clutter);
  add("clutter/voting", vantage::reconstruct_voting, clutter);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
