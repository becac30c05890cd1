#include "bench_planner_rays.hpp"

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <memory>

#include "bare_embree.hpp"
#include "bench_planner_scenes.hpp"
#include "timing.hpp"
#include "vantage/planner/advanced/voxel_scorer.hpp"

namespace vantage::bench {
namespace {

/// All of a scene's shadow, seen whole from a few places; the rays of one place follow each other.
/// Few enough that bare Embree's prepared packets stay in the processor's cache.
struct Rays {
  PlannerScene scene = two_pillars_scene(kThesisVoxel, OccluderMode::mesh);
  VoxelScorer scorer{scene.scene};
  std::vector<std::vector<PinholeCamera>> places;
  std::vector<TriangleMesh> meshes;
  Workload work{"", &meshes, {}, {}, {}, false, false, false};
  std::unique_ptr<BareScene> bare_scene;
  std::unique_ptr<BareRays> bare_rays;
  std::vector<std::uint8_t> hidden;

  Rays() {
    for (const KnownObject& object : scene.world.objects) {
      meshes.push_back(object.mesh->transformed(object.T_world_object));
    }
    const PointsView points = scene.scene.shadow_centres();
    for (const auto& place : sites(scene.views(full_views()))) {
      if (places.size() == 8) break;
      if (scorer.upper_bound(place[0]) != points.size) continue;
      places.push_back({place[0]});
      for (std::size_t i = 0; i < points.size; ++i) add(points[i], place[0].centre());
      while (work.size() % kPacketWidth != 0) add(work.origins[work.size() - 1], last_end());
    }
    bare_scene = std::make_unique<BareScene>(meshes);
    bare_rays = std::make_unique<BareRays>(work);
    hidden.resize(work.size());
  }

  void add(const Eigen::Vector3f& from, const Eigen::Vector3d& to) {
    const Eigen::Vector3f end = to.cast<float>();
    work.origins.push_back(from), work.ends.push_back(end);
    work.directions.push_back(end - from);
  }
  Eigen::Vector3d last_end() const { return work.ends[work.size() - 1].cast<double>(); }

  std::uint64_t seen() const {
    std::uint64_t sum = 0;
    for (const auto& place : places) sum += scorer.ViewScorer::score(place[0]).score;
    return sum;
  }
  void trace_bare() { bare_rays->occluded16(*bare_scene, hidden.data(), false); }
};

void run(benchmark::State& state, Rays& rays) {
  tbb::task_arena one(1);
  std::vector<double> shares, bare_seconds;
  one.execute([&] {
    rays.seen(), rays.trace_bare();
    for (auto _ : state) {
      const double ours = thread_seconds([&] { rays.seen(); });
      const double bare = thread_seconds([&] { rays.trace_bare(); });
      state.SetIterationTime(ours);
      shares.push_back(bare / ours), bare_seconds.push_back(bare);
    }
  });
  state.SetItemsProcessed(state.iterations() * std::int64_t(rays.work.size()));
  state.counters["of_bare_rate"] = median(shares);
  state.counters["bare/s"] = double(rays.work.size()) / median(bare_seconds);
}

}  // namespace

void add_ray_rows() {
  const auto rays = std::make_shared<Rays>();
  benchmark::RegisterBenchmark("voxel/two pillars/rays of scores against bare Embree",
                               [=](benchmark::State& state) { run(state, *rays); })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond)
      ->Iterations(301);
}

}  // namespace vantage::bench
