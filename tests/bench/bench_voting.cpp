// How voting grows with the number of observations: time, and the most memory that it has at once.
// More objects (castles of five cubes, each with nine cameras of its own), and more cameras around
// the same five cubes.

#include <benchmark/benchmark.h>
#include <malloc.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "reconstruction/synthetic_views.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

namespace {

std::atomic<std::int64_t> live_bytes{0}, max_bytes{0};

void count(std::int64_t bytes) {
  const std::int64_t now = live_bytes += bytes;
  std::int64_t most = max_bytes;
  while (now > most && !max_bytes.compare_exchange_weak(most, now)) {
  }
}

void* counted(void* memory) {
  if (!memory) throw std::bad_alloc();
  count(std::int64_t(malloc_usable_size(memory)));
  return memory;
}

void release(void* memory) {
  if (memory) count(-std::int64_t(malloc_usable_size(memory)));
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
  return counted(std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = std::size_t(alignment);
  return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}
void operator delete(void* memory) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  release(memory);
}

namespace vantage::bench {
namespace {

MemoryKnowledgeBase five_cubes() {
  std::vector<ObjectType> types;
  for (const std::string name : {"red", "green", "blue", "purple", "yellow"}) {
    types.push_back(test::marked_box(name + " cube", {0.05, 0.05, 0.05}, 6 * int(types.size())));
  }
  return MemoryKnowledgeBase(std::move(types));
}

/// What `cameras` see of a castle that stands 3 metres times `place` off the origin.
std::vector<CameraView> castle(const MemoryKnowledgeBase& knowledge, int place, int cameras) {
  const std::vector<Eigen::Vector3d> middles{
      {-0.06, 0, 0.025}, {0, 0, 0.025}, {0.06, 0, 0.025}, {-0.03, 0, 0.075}, {0.03, 0, 0.075}};
  std::vector<test::PlacedObject> objects;
  for (std::size_t i = 0; i < middles.size(); ++i) {
    objects.push_back({knowledge.types()[i], Pose::from_translation(middles[i])});
  }
  test::Random random(std::uint32_t(place) + 1);
  auto views = test::cameras_around(random, cameras);
  test::look_at(views, objects, {}, random);
  for (CameraView& view : views) {
    view.T_world_cam = Pose::from_translation({3.0 * place, 0, 0}) * *view.T_world_cam;
  }
  return views;
}

/// Leaves out what is more than `count`; the last view may be shortened.
std::size_t keep(std::vector<CameraView>& views, std::size_t count) {
  std::size_t kept = 0;
  for (CameraView& view : views) {
    if (kept + view.observations.size() > count) view.observations.resize(count - kept);
    kept += view.observations.size();
  }
  return kept;
}

std::vector<CameraView> more_objects(const MemoryKnowledgeBase& knowledge, std::size_t count) {
  std::vector<CameraView> views;
  for (int place = 0; place < int(count / 50 + 1); ++place) {
    for (CameraView& view : castle(knowledge, place, 9)) views.push_back(std::move(view));
  }
  return views;
}

std::vector<CameraView> more_cameras(const MemoryKnowledgeBase& knowledge, std::size_t count) {
  return castle(knowledge, 0, int(count / 5 + 1));
}

using Maker = std::vector<CameraView> (*)(const MemoryKnowledgeBase&, std::size_t);

void run(benchmark::State& state, Maker make) {
  const MemoryKnowledgeBase knowledge = five_cubes();
  auto views = make(knowledge, std::size_t(state.range(0)));
  state.counters["observations"] = double(keep(views, std::size_t(state.range(0))));
  tbb::task_arena arena(1);
  std::size_t objects = 0;
  std::int64_t most = 0;
  for (auto _ : state) {
    const std::int64_t before = live_bytes;
    max_bytes = before;
    arena.execute([&] { objects = reconstruct_voting(views, knowledge).objects.size(); });
    most = max_bytes - before;
  }
  state.counters["objects"] = double(objects);
  state.counters["MB"] = double(most) * 1e-6;
}

void add(const char* name, Maker make) {
  benchmark::RegisterBenchmark(name, run, make)
      ->RangeMultiplier(10)
      ->Range(10, 10000)
      ->Unit(benchmark::kMillisecond);
}

}  // namespace
}  // namespace vantage::bench

int main(int argc, char** argv) {
  using namespace vantage::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  add("more objects", more_objects);
  add("more cameras", more_cameras);
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}
