// Rays through what no camera saw: four lattices of 640×480 images, 40 views of 160×120 pixels.
//
// `time_over_bare` compares with the same rays, one closest hit each, against the four surfaces in
// one bare Embree scene: the median of ratios measured in turns. All in one thread.

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <memory>
#include <string>

#include "bare_embree.hpp"
#include "seen_scene.hpp"
#include "timing.hpp"
#include "vantage/raycore/advanced/unobserved_space.hpp"

namespace vantage::bench {
namespace {

std::vector<PixelTile> tiles_of(const PinholeCamera& camera) {
  std::vector<PixelTile> tiles;
  for (int row = 0; row < camera.intrinsics().height / PixelTile::kSide; ++row) {
    for (int column = 0; column < camera.intrinsics().width / PixelTile::kSide; ++column) {
      tiles.push_back({std::uint16_t(column), std::uint16_t(row)});
    }
  }
  return tiles;
}

/// A view's rays, tile by tile.
Workload rays_of(const PinholeCamera& camera, const std::vector<TriangleMesh>& scene) {
  Workload work{"view", &scene, {}, {}, {}, false, true, true};
  for (const PixelTile& tile : tiles_of(camera)) {
    for (int i = 0; i < PixelTile::kPixels; ++i) {
      const PixelRay ray = camera.pixel_ray(PixelTile::kSide * tile.column + i % PixelTile::kSide,
                                            PixelTile::kSide * tile.row + i / PixelTile::kSide);
      work.origins.push_back(ray.origin.cast<float>());
      work.directions.push_back(ray.direction.cast<float>());
    }
  }
  return work;
}

struct Fixture {
  std::vector<VisibilityMesh> lattices;
  std::vector<TriangleMesh> meshes;
  std::vector<PinholeCamera> viewers = seen_viewers();
  std::vector<PixelTile> tiles = tiles_of(viewers[0]);
  std::vector<UnseenHits> unseen{tiles.size()};
  std::size_t rays = tiles.size() * PixelTile::kPixels;

  explicit Fixture(int step) : lattices(seen_lattices(step)) {
    for (const VisibilityMesh& lattice : lattices) meshes.push_back(visibility_mesh(lattice));
  }
};

void views(benchmark::State& state, int step) {
  Fixture f(step);
  const UnobservedSpace space(f.lattices, seen_box());
  const BareScene bare(f.meshes);
  std::vector<BareRays> bare_rays;
  for (const PinholeCamera& viewer : f.viewers) bare_rays.emplace_back(rays_of(viewer, f.meshes));
  Hits hits;
  hits.resize(f.rays);
  std::vector<double> ratios;
  const auto ours = [&] {
    for (const PinholeCamera& viewer : f.viewers) space.first_unseen(viewer, f.tiles, f.unseen);
  };
  const auto other = [&] {
    for (BareRays& rays : bare_rays) rays.intersect16(bare, hits, true);
  };
  std::vector<double> times;
  for (auto _ : state) {
    const double seconds = thread_seconds(ours), bare_seconds = thread_seconds(other);
    state.SetIterationTime(seconds);
    times.push_back(seconds);
    ratios.push_back(seconds / bare_seconds);
  }
  const std::size_t count = f.viewers.size();
  state.SetItemsProcessed(state.iterations() * std::int64_t(f.rays * count));
  state.counters["ms_per_view"] = 1e3 * median(times) / double(count);
  state.counters["time_over_bare"] = median(ratios);
}

/// One lattice's volume as a UnobservedSpace builds it, and as triangles.
void build(benchmark::State& state, int step) {
  const Fixture f(step);
  tbb::task_arena one(1);
  std::vector<double> ratios;
  one.execute([&] {
    for (auto _ : state) {
      const double seconds = thread_seconds([&] {
        UnobservedSpace space({&f.lattices[0], 1}, seen_box());
      });
      const double bare_seconds = thread_seconds([&] { BareScene bare({f.meshes[0]}); });
      state.SetIterationTime(seconds);
      ratios.push_back(bare_seconds / seconds);
    }
  });
  state.counters["triangles_over_grid"] = median(ratios);
}

void add(const std::string& name, void (*run)(benchmark::State&, int), int step) {
  benchmark::RegisterBenchmark((name + "/every " + std::to_string(step) + ". pixel").c_str(),
                               [=](benchmark::State& state) { run(state, step); })
      ->UseManualTime()
      ->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace vantage::bench

int main(int argc, char** argv) {
  using namespace vantage::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  for (const int step : {8, 1}) {
    add("40 views", views, step);
    add("build", build, step);
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
