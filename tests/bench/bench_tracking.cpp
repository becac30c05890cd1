// What following objects over time adds to the reconstruction of each instant: N objects of five
// types, four cameras with depth, features that are computed, not detected. Arg: N.

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <string>
#include <vector>

#include "reconstruction/synthetic_views.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/reconstruction/tracking.hpp"

namespace vantage::bench {
namespace {

constexpr int kCameras = 4;
constexpr int kInstants = 20;

/// Instants as cameras see them, with what is reconstructed of each.
struct Recording {
  std::shared_ptr<const MemoryKnowledgeBase> knowledge;
  std::vector<std::vector<CameraView>> views;
  std::vector<DepthCamera> depth;  // nothing moves
  std::vector<Reconstruction> reconstructions;
};

std::vector<DepthCamera> depth_of(const std::vector<CameraView>& views,
                                  const std::vector<test::PlacedObject>& objects) {
  SceneBuilder builder;
  for (const test::PlacedObject& object : objects) {
    builder.add_instance(object.type->mesh, object.T_world_object);
  }
  const auto scene = builder.build();
  std::vector<DepthCamera> depth;
  for (const CameraView& view : views) {
    const PinholeCamera camera(view.lens.intrinsics(), *view.T_world_cam);
    depth.push_back({view.name, camera, std::make_shared<DepthImage>(scene->render_depth(camera))});
  }
  return depth;
}

Recording record(int count) {
  Recording recording;
  std::vector<ObjectType> types;
  for (int t = 0; t < 5; ++t) {
    types.push_back(test::marked_box("box " + std::to_string(t), {0.05, 0.05, 0.05}, 6 * t));
  }
  recording.knowledge = std::make_shared<MemoryKnowledgeBase>(std::move(types));
  test::Random random(2);
  const auto objects =
      test::scattered(random, recording.knowledge->types(), count, 0.06 * std::sqrt(count));
  const auto cameras = test::cameras_around(random, kCameras, 0.5 + 0.05 * std::sqrt(count));
  for (int i = 0; i < kInstants; ++i) {
    recording.views.push_back(cameras);
    test::look_at(recording.views.back(), objects, {.missing = 0.2, .wrong_id = 0.05}, random);
    recording.reconstructions.push_back(
        reconstruct_pnp(recording.views.back(), *recording.knowledge));
  }
  recording.depth = depth_of(cameras, objects);
  return recording;
}

void track(benchmark::State& state, bool with_depth) {
  const Recording recording = record(int(state.range(0)));
  tbb::task_arena arena(2);
  std::size_t objects = 0;
  for (auto _ : state) {
    arena.execute([&] {
      ObjectTracker tracker(recording.knowledge, {});
      for (std::size_t i = 0; i < recording.views.size(); ++i) {
        Snapshot snapshot{double(i), recording.views[i]};
        if (with_depth) snapshot.depth = recording.depth;
        objects = tracker.update(snapshot, recording.reconstructions[i]).objects.size();
      }
    });
  }
  state.counters["objects"] = double(objects);
  state.counters["instants/s"] =
      benchmark::Counter(double(kInstants), benchmark::Counter::kIsIterationInvariantRate);
}

void reconstruct(benchmark::State& state) {
  const Recording recording = record(int(state.range(0)));
  tbb::task_arena arena(2);
  for (auto _ : state) {
    arena.execute([&] {
      for (const auto& views : recording.views) {
        benchmark::DoNotOptimize(reconstruct_pnp(views, *recording.knowledge));
      }
    });
  }
  state.counters["instants/s"] =
      benchmark::Counter(double(kInstants), benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK_CAPTURE(track, "with depth", true)
    ->Arg(5)
    ->Arg(10)
    ->Arg(20)
    ->Arg(40)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK_CAPTURE(track, "without depth", false)
    ->Arg(20)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(reconstruct)->Arg(20)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace vantage::bench

BENCHMARK_MAIN();
