#include "bench_volume_changes.hpp"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <memory>
#include <vector>

#include "bench_volume_scenes.hpp"
#include "timing.hpp"
#include "vantage/volume/advanced/classify.hpp"
#include "vantage/volume/shadow_volume.hpp"

namespace vantage::bench {
namespace {

/// The same image with something a tenth nearer in a part of it.
std::shared_ptr<const DepthImage> with_something_new(const DepthImage& image) {
  DepthImage changed = image;
  for (int v = image.height() / 3; v < image.height() / 2; ++v) {
    for (int u = image.width() / 3; u < image.width() / 2; ++u) {
      changed.set(u, v, 0.9f * image.at(u, v));
    }
  }
  return std::make_shared<const DepthImage>(std::move(changed));
}

Pose a_little_aside(const Pose& pose) {
  return Pose::from_translation({0.01, 0.02, 0}) * pose;
}

/// One thing that changes to and fro in a world, and the call that tells a volume.
struct Change {
  std::string name;
  std::function<void(WorldModel& world, bool there)> change;
  std::function<void(ShadowVolume& volume, const WorldModel& world)> tell;
};

void tell_objects(ShadowVolume& volume, const WorldModel& world) {
  volume.set_objects(world.objects);
}

Change new_depth(const WorldModel& world) {
  const auto before = world.cameras[0].depth, after = with_something_new(*before);
  return {"set_depth",
          [=](WorldModel& w, bool there) { w.cameras[0].depth = there ? after : before; },
          [](ShadowVolume& v, const WorldModel& w) { v.set_depth(0, w.cameras[0].depth); }};
}

Change moved_camera(const WorldModel& world) {
  const PinholeCamera before = world.cameras[0].camera;
  const PinholeCamera after = before.moved_to(a_little_aside(before.T_world_cam()));
  return {"move_camera",
          [=](WorldModel& w, bool there) { w.cameras[0].camera = there ? after : before; },
          [](ShadowVolume& v, const WorldModel& w) {
            v.move_camera(0, w.cameras[0].camera.T_world_cam(), w.cameras[0].depth);
          }};
}

/// Only the way there is measured.
Change last_camera(const WorldModel& world, bool comes) {
  const DepthCamera last = world.cameras.back();
  return {comes ? "add_camera" : "remove_camera",
          [=](WorldModel& w, bool there) {
            there == comes ? w.cameras.push_back(last) : w.cameras.pop_back();
          },
          [](ShadowVolume& v, const WorldModel& w) {
            if (w.cameras.size() > v.camera_count()) {
              v.add_camera(w.cameras.back());
            } else {
              v.remove_camera(v.camera_count() - 1);
            }
          }};
}

Change moved_object(const WorldModel& world) {
  const Pose before = world.objects[0].T_world_object, after = a_little_aside(before);
  return {"set_objects, one moved",
          [=](WorldModel& w, bool there) { w.objects[0].T_world_object = there ? after : before; },
          tell_objects};
}

Change new_object(const WorldModel& world) {
  const KnownObject last = world.objects.back();
  return {
      "set_objects, one gone",
      [=](WorldModel& w, bool there) { there ? w.objects.pop_back() : w.objects.push_back(last); },
      tell_objects};
}

Change all_objects(const WorldModel& world) {
  const std::vector<KnownObject> before = world.objects;
  std::vector<KnownObject> after = before;
  for (KnownObject& object : after) object.T_world_object = a_little_aside(object.T_world_object);
  return {"set_objects, all moved",
          [=](WorldModel& w, bool there) { w.objects = there ? after : before; }, tell_objects};
}

Change nothing() {
  return {"grid, nothing changed", [](WorldModel&, bool) {},
          [](ShadowVolume&, const WorldModel&) {}};
}

void follow(benchmark::State& state, WorldModel world, const GridGeometry& geometry,
            const Change& change, const std::string& what, const Report& report) {
  tbb::task_arena one(1);
  one.execute([&] {
    if (change.name == "add_camera") change.change(world, false);
    ShadowVolume volume(world, geometry);
    std::shared_ptr<const StateGrid> grid = volume.grid(), expected;
    std::vector<double> ours, grids, plain;
    for (auto _ : state) {
      change.change(world, true);
      ours.push_back(thread_seconds([&] { change.tell(volume, world); }));
      grids.push_back(thread_seconds([&] { grid = volume.grid(); }));
      ours.back() += grids.back();
      plain.push_back(thread_seconds([&] { expected = classify(world, geometry); }));
      state.SetIterationTime(ours.back());
      if (grid->count(VoxelState::shadow) != expected->count(VoxelState::shadow)) {
        state.SkipWithError("starting over gives another grid");
      }
      change.change(world, false);
      change.tell(volume, world);
      grid = volume.grid();
    }
    const double ms = 1e3 * median(ours), plain_ms = 1e3 * median(plain);
    state.counters["grid_ms"] = 1e3 * median(grids);
    state.counters["start_over_ms"] = plain_ms;
    state.counters["times_faster"] = plain_ms / ms;
    report(fmt::format("{}: {}", what, change.name),
           fmt::format("{:.3f} ms, {:.3f} of them for the grid; starting over {:.1f} ms: {:.1f} "
                       "times faster",
                       ms, 1e3 * median(grids), plain_ms, plain_ms / ms));
  });
}

}  // namespace

void add_changes(const Report& report) {
  const auto world = std::make_shared<const WorldModel>(cell());
  for (const double size : {0.01, 0.005}) {
    const GridGeometry geometry = GridGeometry::covering(cell_area(), size);
    const std::string what = fmt::format("cell, {} mm", 1e3 * size);
    for (const Change& change : {new_depth(*world), moved_camera(*world), last_camera(*world, true),
                                 last_camera(*world, false), moved_object(*world),
                                 new_object(*world), all_objects(*world), nothing()}) {
      benchmark::RegisterBenchmark(
          ("changes/" + what + "/" + change.name).c_str(),
          [=](benchmark::State& state) { follow(state, *world, geometry, change, what, report); })
          ->UseManualTime()
          ->Unit(benchmark::kMillisecond)
          ->Iterations(7);
    }
  }
}

}  // namespace vantage::bench
