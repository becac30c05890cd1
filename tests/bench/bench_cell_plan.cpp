// Plans of simulated workcells, from a classified grid to the answer, in all threads of the
// machine: voxel (by bound, and by expected gain) and shadow D6, production and full set, servo 5,
// with and without polishing. What hides is voxels, as in the thesis.
//
//   bench_cell_plan [CELL...] [--benchmark_...]
//
// Cells are named as for `vantage evaluate planning`, e.g. wall.yaml:front
// foreign_objects.yaml+ideal. Without any, those two of the folder it is run in.

#include <benchmark/benchmark.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "evaluate/planning/planning_cell.hpp"
#include "vantage/planner/plan.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage::bench {
namespace {

struct ClassifiedCell {
  PlanningCell cell;
  std::shared_ptr<const StateGrid> grid;
};
using Shared = std::shared_ptr<const ClassifiedCell>;

Shared classified(const std::string& name) {
  PlanningCell cell = load_planning_cell(planning_cell_name(name), DepthKind::none, 0);
  PlanRequest& request = cell.request;
  request.volume.occluders = OccluderMode::voxels;
  request.volume.anti_alias.reset();
  const auto geometry = GridGeometry::covering(request.work_area, request.voxel_size_m);
  const auto grid = classify(cell.world, geometry, request.volume);
  return std::make_shared<const ClassifiedCell>(ClassifiedCell{std::move(cell), grid});
}

void add(const Shared& cell, const std::string& method, const std::string& set, int polish) {
  PlanRequest request = cell->cell.request;
  const bool expected = method == "expected";
  request.method = expected ? Method(VoxelMethod{}) : method_named(method);
  request.value = expected ? ViewValue::expected : ViewValue::bound;
  request.candidates = set == "full" ? full_views() : production_views();
  request.polish.views = polish;
  const std::string name =
      cell->cell.name + "/" + method + "/" + set + "/polish " + std::to_string(polish);
  benchmark::RegisterBenchmark(
      name.c_str(),
      [=](benchmark::State& state) {
        for (auto _ : state) {
          const Plan plan = plan_next_view(cell->cell.world, cell->grid, request);
          if (plan.best() == nullptr) state.SkipWithError("no view");
        }
        state.counters["shadow_voxels"] = double(cell->grid->count(VoxelState::shadow));
      })
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond);
}

void add_plans(const std::string& cell_name) {
  const Shared cell = classified(cell_name);
  for (const char* method : {"voxel", "expected", "shadow"}) {
    for (const int polish : {0, 2}) add(cell, method, "production", polish);
    add(cell, method, "full", 0);
  }
}

}  // namespace
}  // namespace vantage::bench

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  std::vector<std::string> cells(argv + 1, argv + argc);
  if (cells.empty()) cells = {"wall.yaml:front", "foreign_objects.yaml+ideal"};
  try {
    for (const std::string& cell : cells) vantage::bench::add_plans(cell);
  } catch (const vantage::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
  benchmark::RunSpecifiedBenchmarks();
}
