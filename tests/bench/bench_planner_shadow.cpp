#include "bench_planner_shadow.hpp"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include "bare_embree.hpp"
#include "bench_planner_scenes.hpp"
#include "timing.hpp"
#include "vantage/planner/advanced/shadow_scorer.hpp"
#include "vantage/planner/plan.hpp"

namespace vantage::bench {
namespace {

constexpr double kPower = 6;
using Rows = std::vector<std::pair<std::string, std::string>>;

std::vector<PixelTile> all_tiles(const Intrinsics& image) {
  std::vector<PixelTile> tiles;
  for (int row = 0; 4 * row < image.height; ++row) {
    for (int column = 0; 4 * column < image.width; ++column) {
      tiles.push_back({std::uint16_t(column), std::uint16_t(row)});
    }
  }
  return tiles;
}

/// Every pixel of a view, one ray after the other.
double score_by_single_rays(const PlannerScene& s, const PinholeCamera& view) {
  double sum = 0;
  for (int v = 0; v < view.intrinsics().height; ++v) {
    for (int u = 0; u < view.intrinsics().width; ++u) {
      const PixelRay ray = view.pixel_ray(u, v);
      const auto hit =
          s.scene.surfaces().closest_hit({ray.origin.cast<float>(), ray.direction.cast<float>()});
      if (!hit || hit->object != s.scene.shadow_object()) continue;
      const double d = double(hit->t), cube = d * d * d;
      sum += cube * cube;
    }
  }
  return sum;
}

double score_by_packets(const PlannerScene& s, const PinholeCamera& view,
                        const std::vector<PixelTile>& tiles, std::vector<TileHits>& hits) {
  s.scene.surfaces().first_hits(view, tiles, hits);
  double sum = 0;
  for (const TileHits& tile : hits) {
    for (int i = 0; i < PixelTile::kPixels; ++i) {
      if (tile.object[i] != s.scene.shadow_object()) continue;
      const double d = double(tile.t[i]), cube = d * d * d;
      sum += cube * cube;
    }
  }
  return sum;
}

std::vector<PinholeCamera> some_of(const std::vector<PinholeCamera>& views, std::size_t count) {
  std::vector<PinholeCamera> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(views[i * views.size() / count]);
  return some;
}

/// Processor time per view, microseconds; the median of some rounds.
template <class Use>
double view_us(const std::vector<PinholeCamera>& views, const Use& use) {
  std::vector<double> times;
  for (int round = 0; round < 3; ++round) {
    times.push_back(thread_seconds([&] {
      for (const PinholeCamera& view : views) use(view);
    }));
  }
  return 1e6 * median(times) / double(views.size());
}

PlanRequest request_for(const PlannerScene& s, const CandidateSet& set, const Method& method,
                        int servo_iterations) {
  PlanRequest request{.work_area = s.area, .intrinsics = s.camera.intrinsics()};
  request.range = s.camera.range();
  request.candidates = set;
  request.method = method;
  request.servo.iterations = servo_iterations;
  return request;
}

/// Wall time, and the processor time of all threads: on a busy machine the one says little.
struct PlanTime {
  double wall_s, processor_s;
};
PlanTime plan_time(const PlannerScene& s, const PlanRequest& request, int threads) {
  const auto processor = [] {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
  };
  tbb::task_arena arena(threads);
  const double before = processor();
  const double wall =
      wall_seconds([&] { arena.execute([&] { plan_next_view(s.world, s.grid, request); }); });
  return {wall, processor() - before};
}

/// The plan with the least processor time of some: what it takes when nobody disturbs.
PlanTime best_plan_time(const PlannerScene& s, const PlanRequest& request, int threads) {
  PlanTime best = plan_time(s, request, threads);
  for (int round = 0; round < 9; ++round) {
    const PlanTime time = plan_time(s, request, threads);
    if (time.processor_s < best.processor_s) best = time;
  }
  return best;
}

/// One view after another: what single rays, packets, the drawn faces and the bound cost.
double report_views(const PlannerScene& s, const std::vector<PinholeCamera>& views, Rows& rows) {
  const ShadowScorer scorer(s.scene, s.camera.range(), kPower);
  const std::vector<PixelTile> tiles = all_tiles(s.camera.intrinsics());
  std::vector<TileHits> hits(tiles.size());
  volatile double sink = 0;
  const double single =
      view_us(some_of(views, 12), [&](const auto& v) { sink = sink + score_by_single_rays(s, v); });
  const double packets = view_us(some_of(views, 60), [&](const auto& v) {
    sink = sink + score_by_packets(s, v, tiles, hits);
  });
  const double clipped = view_us(
      some_of(views, 400), [&](const auto& v) { sink = sink + double(scorer.score(v).score); });
  const double bound = view_us(some_of(views, 4000),
                               [&](const auto& v) { sink = sink + double(scorer.upper_bound(v)); });
  const Intrinsics& k = s.camera.intrinsics();
  const Intrinsics small{
      160, 120, k.fx / 4, k.fy / 4, (k.cx + 0.5) / 4 - 0.5, (k.cy + 0.5) / 4 - 0.5};
  std::vector<PinholeCamera> servo;
  for (const PinholeCamera& v : some_of(views, 4000)) {
    servo.emplace_back(small, v.T_world_cam(), v.range());
  }
  const double borders = view_us(
      servo, [&](const auto& v) { sink = sink + double(scorer.shadow_bounds(v).has_value()); });
  rows.emplace_back(
      s.name + ", per 640×480 view",
      fmt::format("single rays {:.0f} µs, packets {:.0f} (÷ {:.1f}), where shadow may be {:.0f} "
                  "(÷ {:.0f}), bound {:.1f} µs; borders at 160×120 {:.1f} µs",
                  single, packets, single / packets, clipped, single / clipped, bound, borders));
  return single * 1e-6;
}

void report_bounds(const PlannerScene& s, const std::vector<PinholeCamera>& views, Rows& rows) {
  const ShadowScorer scorer(s.scene, s.camera.range(), kPower);
  std::vector<double> ratios;
  Score best = 0;
  std::vector<std::pair<Score, Score>> scores;
  for (const PinholeCamera& view : some_of(views, 1000)) {
    scores.emplace_back(scorer.score(view).score, scorer.upper_bound(view));
    best = std::max(best, scores.back().first);
  }
  for (const auto& [score, bound] : scores) {
    if (score > best / 10) ratios.push_back(double(bound) / double(score));
  }
  std::size_t left = 0;
  for (const PinholeCamera& view : views) left += scorer.upper_bound(view) >= best;
  std::sort(ratios.begin(), ratios.end());
  rows.emplace_back(
      s.name + ", bound / score",
      fmt::format("median {:.2f}, 9 of 10 below {:.2f}; {} of {} views left",
                  ratios[ratios.size() / 2], ratios[ratios.size() * 9 / 10], left, views.size()));
}

void report_search(const PlannerScene& s, std::size_t views, double single_s, Rows& rows) {
  const double full_s =
      plan_time(s, request_for(s, full_views(), ShadowMethod{kPower}, 0), 1).processor_s;
  rows.emplace_back(
      s.name + ", full set, no servo, one thread",
      fmt::format("{:.2f} s; single rays for every pixel {:.0f} s: ÷ {:.0f} (goal 30)", full_s,
                  single_s * double(views), single_s * double(views) / full_s));
  for (const Method& method : {Method(ShadowMethod{kPower}), Method(VoxelMethod{})}) {
    const PlanTime full = plan_time(s, request_for(s, full_views(), method, 5), 2);
    const PlanTime few = best_plan_time(s, request_for(s, production_views(), method, 5), 2);
    const bool shadow = std::holds_alternative<ShadowMethod>(method);
    rows.emplace_back(
        fmt::format("{}, {}, servo 5, two threads", s.name, name_of(method)),
        fmt::format("full set {:.2f} s (goal {}; processor {:.2f} s), production set {:.1f} ms "
                    "(goal {}; processor {:.1f} ms)",
                    full.wall_s, shadow ? 15 : 3, full.processor_s, 1e3 * few.wall_s,
                    shadow ? 25 : 10, 1e3 * few.processor_s));
  }
}

/// The rays of some tiles in the middle of a view, for bare Embree.
Workload workload_of(const PinholeCamera& view, const std::vector<PixelTile>& tiles,
                     const std::vector<TriangleMesh>& meshes) {
  Workload work;
  work.name = "tiles";
  work.scene = &meshes;
  work.one_origin = work.coherent = true;
  for (const PixelTile& tile : tiles) {
    for (int i = 0; i < PixelTile::kPixels; ++i) {
      const PixelRay ray = view.pixel_ray(4 * tile.column + i % 4, 4 * tile.row + i / 4);
      work.origins.push_back(ray.origin.cast<float>());
      work.directions.push_back(ray.direction.cast<float>());
      work.ends.push_back((ray.origin + ray.direction).cast<float>());
    }
  }
  return work;
}

void report_rays(const PlannerScene& s, const PinholeCamera& view, Rows& rows) {
  std::vector<TriangleMesh> meshes;
  for (const KnownObject& object : s.world.objects) {
    meshes.push_back(object.mesh->transformed(object.T_world_object));
  }
  meshes.push_back(s.scene.shadow_faces());
  const BareScene bare(meshes);
  std::vector<PixelTile> tiles;
  for (const PixelTile& tile : all_tiles(view.intrinsics())) {
    if (tile.column >= 60 && tile.column < 92 && tile.row >= 52 && tile.row < 68) {
      tiles.push_back(tile);
    }
  }
  const Workload work = workload_of(view, tiles, meshes);
  BareRays rays(work);
  Hits bare_hits;
  bare_hits.resize(work.size());
  std::vector<TileHits> hits(tiles.size());
  std::vector<double> bare_s, ours_s;
  for (int round = 0; round < 200; ++round) {
    bare_s.push_back(thread_seconds([&] { rays.intersect16(bare, bare_hits, true); }));
    ours_s.push_back(thread_seconds([&] { s.scene.surfaces().first_hits(view, tiles, hits); }));
  }
  rows.emplace_back(
      s.name + ", rays per second",
      fmt::format("{:.0f} million, {:.2f} of bare Embree's on the same rays (goal 0.8)",
                  1e-6 * double(work.size()) / median(ours_s), median(bare_s) / median(ours_s)));
}

}  // namespace

std::vector<std::pair<std::string, std::string>> shadow_report() {
  Rows rows;
  for (const auto make : {wall_scene, two_pillars_scene, corridor_scene}) {
    const PlannerScene s = make(kThesisVoxel, OccluderMode::mesh);
    const std::vector<PinholeCamera> views = s.views(full_views());
    const double single_s = report_views(s, views, rows);
    report_bounds(s, views, rows);
    report_rays(s, views[views.size() / 2], rows);
    report_search(s, views.size(), single_s, rows);
  }
  return rows;
}

}  // namespace vantage::bench
