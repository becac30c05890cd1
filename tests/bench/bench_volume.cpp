// What one shadow volume costs, and what the plain ways to it cost in the same run.
//
// Rows of Google Benchmark give each measurement with its parts; the table at the end puts the
// ratios beside their goals. Peak memory is measured in fresh processes (bench_volume_probe.hpp).

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bench_volume_carve.hpp"
#include "bench_volume_changes.hpp"
#include "bench_volume_probe.hpp"
#include "bench_volume_scenes.hpp"
#include "reference/thesis_volume.hpp"
#include "timing.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "vantage/volume/shadow_volume.hpp"

namespace vantage::bench {
namespace {

/// The table at the end: what, and how it came out.
std::vector<std::pair<std::string, std::string>>& table() {
  static std::vector<std::pair<std::string, std::string>> rows;
  return rows;
}
/// Google Benchmark runs a row several times with more and more iterations: the last counts.
void report(const std::string& what, const std::string& result) {
  for (auto& [name, before] : table()) {
    if (name == what) return void(before = result);
  }
  table().emplace_back(what, result);
}

template <class Run>
benchmark::internal::Benchmark* add(const std::string& name, const Run& run) {
  return benchmark::RegisterBenchmark(name.c_str(), run)
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

const char* name_of(OccluderMode mode) {
  return mode == OccluderMode::mesh ? "mesh" : "voxels";
}

VolumeOptions options_for(OccluderMode mode) {
  VolumeOptions options;
  options.occluders = mode;
  return options;
}

/// The plain algorithm's time on the wall: minutes on small voxels, so it runs once for all rows.
double thesis_seconds(double voxel_size_m) {
  static std::map<double, double> known;
  if (const auto found = known.find(voxel_size_m); found != known.end()) return found->second;
  const Wall scene = wall();
  const GridGeometry geometry = GridGeometry::covering(wall_area(), voxel_size_m);
  const std::vector<char> solid = scene.solid(geometry);
  return known[voxel_size_m] = thread_seconds([&] {
           benchmark::DoNotOptimize(test::thesis_volume(geometry, solid, scene.cameras, true));
         });
}

/// Where the time goes, milliseconds on one thread.
void add_parts(benchmark::State& state, const WorldModel& world, const GridGeometry& geometry,
               const VolumeOptions& options) {
  WorldModel blind = world;
  blind.cameras.clear();
  const auto folder =
      std::filesystem::temp_directory_path() / fmt::format("vantage-bench-{}", getpid());
  std::filesystem::create_directory(folder);
  std::vector<double> voxelise, both, grid, write;
  for (int i = 0; i < 5; ++i) {
    std::unique_ptr<ShadowVolume> volume;
    std::shared_ptr<const StateGrid> result;
    voxelise.push_back(thread_seconds([&] { ShadowVolume(blind, geometry, options); }));
    both.push_back(
        thread_seconds([&] { volume = std::make_unique<ShadowVolume>(world, geometry, options); }));
    grid.push_back(thread_seconds([&] { result = volume->grid(); }));
    write.push_back(thread_seconds([&] { result->write_vdb(folder / "grid.vdb"); }));
  }
  std::filesystem::remove_all(folder);
  state.counters["voxelise_ms"] = 1e3 * median(voxelise);
  state.counters["trace_ms"] = 1e3 * (median(both) - median(voxelise));
  state.counters["grid_ms"] = 1e3 * median(grid);
  state.counters["write_ms"] = 1e3 * median(write);
}

/// (a) One thread against one thread, in processor time.
void compare_with_thesis(benchmark::State& state, double voxel_size_m, OccluderMode mode,
                         double goal) {
  const WorldModel world = wall().model();
  const GridGeometry geometry = GridGeometry::covering(wall_area(), voxel_size_m);
  const VolumeOptions options = options_for(mode);
  tbb::task_arena one(1);
  one.execute([&] {
    std::vector<double> seconds;
    for (auto _ : state) {
      seconds.push_back(thread_seconds([&] { classify(world, geometry, options); }));
      state.SetIterationTime(seconds.back());
    }
    const double plain = thesis_seconds(voxel_size_m), ratio = plain / median(seconds);
    state.counters["plain_ms"] = 1e3 * plain;
    state.counters["times_faster"] = ratio;
    add_parts(state, world, geometry, options);
    report(fmt::format("wall, {} mm, {}: faster than the plain algorithm", 1e3 * voxel_size_m,
                       name_of(mode)),
           fmt::format("{:.0f} times (goal {:.0f}): {:.2f} ms for {:.0f} ms; voxelise {:.2f}, "
                       "trace {:.2f}, grid {:.2f}, write {:.2f} ms",
                       ratio, goal, 1e3 * median(seconds), 1e3 * plain,
                       double(state.counters["voxelise_ms"]), double(state.counters["trace_ms"]),
                       double(state.counters["grid_ms"]), double(state.counters["write_ms"])));
  });
}

/// (b), (c) and (e) In a process of its own, two threads.
void probe(benchmark::State& state, const std::string& scene, OccluderMode mode,
           double voxel_size_m) {
  for (auto _ : state) {
    const Figures f = run_probe(scene, name_of(mode), voxel_size_m);
    const double ms = f.at("ms"), shadow = f.at("shadow"), peak = f.at("peak_mb");
    state.SetIterationTime(1e-3 * ms);
    for (const auto& [name, value] : f) state.counters[name] = value;
    state.counters["ns_per_shadow"] = 1e6 * ms / shadow;
    report(fmt::format("{}, {:.4g} mm, {}, 2 threads", scene, 1e3 * voxel_size_m, name_of(mode)),
           fmt::format("{:.1f} ms; {:.4g} million voxels, {:.4g} shadow: {:.0f} ns each; "
                       "peak {:.0f} MB, {:.0f} of them for the volume",
                       ms, 1e-6 * f.at("voxels"), 1e-6 * shadow, 1e6 * ms / shadow, peak,
                       peak - f.at("base_mb")));
  }
}

/// Float ties aside, carving gives the same labels.
bool same_labels(const StateGrid& grid, const std::vector<VoxelState>& labels) {
  std::size_t i = 0, differences = 0;
  test::for_each_voxel(grid.geometry(), [&](const Eigen::Vector3i& voxel) {
    differences += grid.at(voxel) != labels[i++];
  });
  return differences * 1000 < labels.size();
}

/// (d) A new frame every time, folded in on two threads, against plain carving on one.
void fold_frame(benchmark::State& state, bool known) {
  const WallFrames scene = wall_frames(known);
  const GridGeometry geometry = GridGeometry::covering(wall_area(), 0.005);
  tbb::task_arena two(2);
  two.execute([&] {
    ShadowVolume volume(scene.world, geometry);
    std::shared_ptr<const StateGrid> grid;
    std::vector<VoxelState> labels;
    std::vector<double> ours, plain, set_depth;
    std::size_t frame = 0;
    for (auto _ : state) {
      frame = (frame + 1) % scene.frames.size();
      DepthCamera observer = scene.world.cameras[0];
      observer.depth = scene.frames[frame];
      set_depth.push_back(wall_seconds([&] { volume.set_depth(0, observer.depth); }));
      ours.push_back(set_depth.back() + wall_seconds([&] { grid = volume.grid(); }));
      plain.push_back(wall_seconds([&] { labels = carve(observer, geometry); }));
      state.SetIterationTime(ours.back());
    }
    if (!known && !same_labels(*grid, labels)) state.SkipWithError("carving gives other labels");
    const double ms = 1e3 * median(ours), plain_ms = 1e3 * median(plain);
    state.counters["set_depth_ms"] = 1e3 * median(set_depth);
    state.counters["carve_ms"] = plain_ms;
    state.counters["times_faster"] = plain_ms / ms;
    report(fmt::format("a depth frame folded in, 5 mm, {} objects, 2 threads",
                       known ? "known" : "no known"),
           fmt::format("{:.2f} ms (goal 33); carving on 1 thread {:.2f} ms: {:.2f} times faster",
                       ms, plain_ms, plain_ms / ms));
  });
}

void add_all() {
  for (const OccluderMode mode : {OccluderMode::mesh, OccluderMode::voxels}) {
    for (const auto& [size, goal] : {std::pair{0.009375, 100.0}, std::pair{0.0046875, 1000.0}}) {
      add(fmt::format("wall against plain/{} mm/{}", 1e3 * size, name_of(mode)),
          [=, s = size, g = goal](auto& state) { compare_with_thesis(state, s, mode, g); });
    }
    for (const double size : {0.009375, 0.0046875, 0.00234375, 0.001171875}) {
      add(fmt::format("wall/{} mm/{}", 1e3 * size, name_of(mode)), [=](auto& state) {
        probe(state, "wall", mode, size);
      })->Iterations(1);
    }
  }
  for (const bool known : {false, true}) {
    add(fmt::format("fold in a frame/{} objects", known ? "known" : "no known"),
        [=](auto& state) { fold_frame(state, known); });
  }
  add_changes(report);
  for (const std::string scene : {"cell", "objects"}) {
    add(scene + "/5 mm/mesh", [=](auto& state) {
      probe(state, scene, OccluderMode::mesh, 0.005);
    })->Iterations(1);
  }
}

}  // namespace
}  // namespace vantage::bench

int main(int argc, char** argv) {
  using namespace vantage::bench;
  if (argc == 5 && std::strcmp(argv[1], kProbe) == 0) return answer_probe(argv + 2);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2);
  add_all();
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  for (const auto& [what, result] : table())
    std::printf("%-58s %s\n", what.c_str(), result.c_str());
  return 0;
}
