// What weighing the objects of a reconstruction costs beside it: N objects of five types, four
// cameras, with and without depth. Arg: N.

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <string>
#include <vector>

#include "reconstruction/synthetic_views.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/check_scene.hpp"

namespace vantage::bench {
namespace {

constexpr int kCameras = 4;

struct Snapshot {
  std::shared_ptr<const MemoryKnowledgeBase> knowledge;
  std::vector<CameraView> views;
  SceneKnowledge scene;
  Reconstruction found;
};

Snapshot snapshot_of(int count, bool with_depth) {
  Snapshot snapshot;
  std::vector<ObjectType> types;
  for (int t = 0; t < 5; ++t) {
    types.push_back(test::marked_box("box " + std::to_string(t), {0.05, 0.05, 0.05}, 6 * t));
  }
  snapshot.knowledge = std::make_shared<MemoryKnowledgeBase>(std::move(types));
  test::Random random(2);
  const auto objects =
      test::scattered(random, snapshot.knowledge->types(), count, 0.06 * std::sqrt(count));
  snapshot.views = test::cameras_around(random, kCameras, 0.5 + 0.05 * std::sqrt(count));
  test::look_at(snapshot.views, objects, {.missing = 0.2, .wrong_id = 0.05}, random);
  snapshot.found = reconstruct_pnp(snapshot.views, *snapshot.knowledge);
  snapshot.scene.solids = {{"table", std::make_shared<TriangleMesh>(box_solid({3, 3, 0.02})),
                            Pose::from_translation({0, 0, -0.2})}};
  SceneBuilder builder;
  for (const test::PlacedObject& object : objects) {
    builder.add_instance(object.type->mesh, object.T_world_object);
  }
  const auto scene = builder.build();
  for (const CameraView& view : snapshot.views) {
    if (!with_depth) break;
    const PinholeCamera camera(view.lens.intrinsics(), *view.T_world_cam);
    snapshot.scene.depth.push_back(
        {view.name, camera, std::make_shared<DepthImage>(scene->render_depth(camera))});
  }
  return snapshot;
}

void weigh(benchmark::State& state, bool with_depth) {
  const Snapshot snapshot = snapshot_of(int(state.range(0)), with_depth);
  tbb::task_arena arena(2);
  std::size_t objects = 0;
  for (auto _ : state) {
    Reconstruction result = snapshot.found;
    arena.execute([&] { reject_contradicted(snapshot.views, snapshot.scene, result); });
    objects = result.objects.size();
  }
  state.counters["objects"] = double(objects);
}

void reconstruct(benchmark::State& state) {
  const Snapshot snapshot = snapshot_of(int(state.range(0)), false);
  tbb::task_arena arena(2);
  for (auto _ : state) {
    arena.execute(
        [&] { benchmark::DoNotOptimize(reconstruct_pnp(snapshot.views, *snapshot.knowledge)); });
  }
}

BENCHMARK_CAPTURE(weigh, "with depth", true)
    ->Arg(5)
    ->Arg(10)
    ->Arg(20)
    ->Arg(40)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(weigh, "without depth", false)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(reconstruct)->Arg(20)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace vantage::bench

BENCHMARK_MAIN();
