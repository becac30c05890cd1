// A plan by the mesh method, from four noisy depth images of 640×480 pixels to the answer: the
// production set (40 candidates), and the full set (34,225), by exact rays and by the shortlist.
//
// Wall time in all threads of the machine. `score_ms` is without classifying the voxel grid, from
// the depth images: visibility meshes, the filter, the search, and polishing where there is any.

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

#include "seen_scene.hpp"
#include "timing.hpp"
#include "vantage/planner/plan.hpp"

namespace vantage::bench {
namespace {

/// The four images' cell, of which nothing is known.
WorldModel cell() {
  WorldModel world;
  for (const PosedDepth& image : seen_images()) {
    world.cameras.push_back({"camera", image.camera, image.depth});
  }
  return world;
}

PlanRequest request_for(const HalfSpheres& candidates, int servo, int polish) {
  PlanRequest request{.work_area = seen_box(),
                      .intrinsics = {640, 480, 615, 615, 319.5, 239.5},
                      .range = {0.05, 2}};
  request.method = MeshMethod{};
  request.candidates = candidates;
  request.servo.iterations = servo;
  request.polish.views = polish;
  return request;
}

void plan(benchmark::State& state, const WorldModel& world, const PlanRequest& request) {
  std::vector<double> score_s;
  for (auto _ : state) {
    const Plan plan = plan_next_view(world, request);
    if (plan.best() == nullptr) state.SkipWithError("nothing to suggest");
    score_s.push_back(plan.score_s);
  }
  state.counters["score_ms"] = 1000 * median(score_s);
}

void add(const std::string& name, int iterations, const WorldModel& world,
         const PlanRequest& request) {
  benchmark::RegisterBenchmark(name.c_str(),
                               [=](benchmark::State& state) { plan(state, world, request); })
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond)
      ->Iterations(iterations);
}

}  // namespace
}  // namespace vantage::bench

int main(int argc, char** argv) {
  using namespace vantage;
  using namespace vantage::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const WorldModel world = cell();
  add("production", 20, world, request_for(production_views(), 0, 0));
  add("production, servo 5", 20, world, request_for(production_views(), 5, 0));
  add("production, servo 5, polish 2", 20, world, request_for(production_views(), 5, 2));
  add("full set, exact", 1, world, request_for(full_views(), 0, 0));
  add("full set, servo 5, shortlist", 1, world, request_for(full_views(), 5, 0));
  benchmark::RunSpecifiedBenchmarks();
}
