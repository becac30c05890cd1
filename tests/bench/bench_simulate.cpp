// Frames per second of the simulated cameras, and what part of bare Embree's ray rate they reach:
// the time of bare calls with the same rays over the camera's time, taken in turns on one thread.

#include <benchmark/benchmark.h>
#include <tbb/task_arena.h>

#include <memory>
#include <string>
#include <vector>

#include "bare_embree.hpp"
#include "simulator/color/color_sensor.hpp"
#include "simulator/depth/depth_sensor.hpp"
#include "simulator/depth/normal_noise.hpp"
#include "simulator/scene/sample_hash.hpp"
#include "timing.hpp"
#include "workload.hpp"

namespace vantage::bench {
namespace {

constexpr Intrinsics kCamera{640, 480, 615, 615, 319.5, 239.5};

/// Like the thesis' Wall: three cubes of 5 cm in a row on the board, one on top, one behind.
std::vector<SimulatedBody> wall_bodies() {
  const auto shape_of = [](const Box& box) {
    return std::make_shared<const TexturedMesh>(TexturedMesh{TriangleMesh::from_box(box)});
  };
  const auto cube = shape_of(Box({-0.025, -0.025, -0.025}, {0.025, 0.025, 0.025}));
  std::vector<SimulatedBody> bodies{
      {"board", shape_of(Box({-0.25, -0.175, -0.01}, {0.25, 0.175, 0})), {}}};
  const std::vector<Eigen::Vector3d> places{
      {-0.05, 0, 0.025}, {0, 0, 0.025}, {0.05, 0, 0.025}, {0, 0, 0.075}, {0, 0.05, 0.025}};
  for (const Eigen::Vector3d& p : places) {
    bodies.push_back({"cube", cube, Pose::from_translation(p)});
  }
  return bodies;
}

struct Setting {
  SimulatedScene scene{wall_bodies()};
  PinholeCamera camera{kCamera, Pose::looking_at({0.12, -0.5, 0.4}, {0, 0, 0.03}), {}};
  std::vector<TriangleMesh> meshes;
  BareScene bare;

  Setting() : meshes(placed_meshes(scene)), bare(meshes) {}

  static std::vector<TriangleMesh> placed_meshes(const SimulatedScene& scene) {
    std::vector<TriangleMesh> meshes;
    for (const SimulatedBody& body : scene.bodies()) {
      meshes.push_back(body.shape->mesh.transformed(body.T_world_body));
    }
    return meshes;
  }
};

/// The pixels' rays, tile by tile as the sensor traces them.
Workload first_rays(const Setting& s) {
  Workload work{"first", &s.meshes, {}, {}, {}, false, true, true};
  for (int tile = 0; tile < kCamera.width * kCamera.height / 16; ++tile) {
    const int tiles_across = kCamera.width / 4;
    for (int i = 0; i < 16; ++i) {
      const PixelRay ray =
          s.camera.pixel_ray(tile % tiles_across * 4 + i % 4, tile / tiles_across * 4 + i / 4);
      work.origins.push_back(ray.origin.cast<float>());
      work.directions.push_back(ray.direction.cast<float>());
      work.ends.push_back((ray.origin + ray.direction).cast<float>());
    }
  }
  return work;
}

/// Sixteen samples of one pixel of every tile, as the colour camera traces them.
Workload sample_rays(const Setting& s) {
  Workload work{"samples", &s.meshes, {}, {}, {}, false, true, true};
  const int tiles_across = kCamera.width / 4;
  for (int tile = 0; tile < kCamera.width * kCamera.height / 16; ++tile) {
    const int u = tile % tiles_across * 4 + tile % 4, v = tile / tiles_across * 4 + tile / 4 % 4;
    for (int i = 0; i < 16; ++i) {
      const PixelRay ray = s.camera.pixel_ray(u + (i % 4 - 1.5) / 4, v + (i / 4 - 1.5) / 4);
      work.origins.push_back(ray.origin.cast<float>());
      work.directions.push_back(ray.direction.cast<float>());
      work.ends.push_back((ray.origin + ray.direction).cast<float>());
    }
  }
  return work;
}

/// From all that the packets of 16 rays met, where they met anything, to `end_of(point, normal,
/// i)`.
template <class EndOf>
Workload second_rays(const Setting& s, const Workload& first, bool one_end, bool coherent,
                     const EndOf& end_of) {
  Workload work{"second", &s.meshes, {}, {}, {}, one_end, false, coherent};
  Hits hits;
  s.scene.rays().closest_hits(first.origins[0], first.directions, hits);
  const auto any_hit = [&](std::size_t packet) {
    for (std::size_t i = 0; i < 16; ++i) {
      if (hits.hit(16 * packet + i)) return true;
    }
    return false;
  };
  for (std::size_t i = 0; i < first.size(); ++i) {
    if (!any_hit(i / 16)) continue;
    const float t = hits.hit(i) ? hits.t[i] : 3.0f;
    const Eigen::Vector3f normal = hits.normal[i];
    const Eigen::Vector3f from = first.origins[i] + t * first.directions[i] + 1e-4f * normal;
    const Eigen::Vector3f end = end_of(from, normal, i);
    work.origins.push_back(from);
    work.directions.push_back(end - from);
    work.ends.push_back(end);
  }
  return work;
}

/// To another device of the camera.
Workload device_rays(const Setting& s, const Workload& first, double offset_m) {
  const Eigen::Vector3f end =
      (s.camera.centre() + offset_m * s.camera.T_world_cam().rotation().col(0)).cast<float>();
  return second_rays(s, first, true, true,
                     [&](const auto&, const auto&, std::size_t) { return end; });
}

Eigen::Vector3f random_vector(std::uint64_t key) {
  Eigen::Vector3f v;
  for (int i = 0; i < 3; ++i) {
    v[i] = simulator::detail::signed_unit(std::uint32_t(sample_hash(key, i)));
  }
  return v;
}

/// To points all over the lamp.
Workload lamp_rays(const Setting& s, const Workload& first) {
  const Lighting light;
  return second_rays(s, first, false, true, [&](const auto&, const auto&, std::size_t i) {
    return Eigen::Vector3f(light.lamp_centre_m + 0.4f * light.lamp_side_m * random_vector(i));
  });
}

/// Over the half-space in front of the surface, as far as the sky's light is looked for.
Workload sky_rays(const Setting& s, const Workload& first) {
  const float reach = Lighting().sky_reach_m;
  return second_rays(
      s, first, false, false, [&](const auto& from, const auto& normal, std::size_t i) {
        return Eigen::Vector3f(
            from + reach * (random_vector(i).normalized() + 1.001f * normal).normalized());
      });
}

/// A part of an image's rays by Embree alone, again and again: prepared packets that stay in
/// the cache, so that Embree does not wait for memory. What it takes for all of them follows.
class BarePart {
 public:
  explicit BarePart(const Workload& all)
      : rays_(all.size()), work_(in_cache(all)), bare_(work_), blocked_(work_.size()) {
    hits_.resize(work_.size());
  }

  double seconds_of_all(const BareScene& scene) {
    constexpr int kRounds = 8;
    trace(scene);  // brings the packets back into the cache
    const double seconds = thread_seconds([&] {
      for (int round = 0; round < kRounds; ++round) trace(scene);
    });
    return seconds / kRounds * double(rays_) / double(work_.size());
  }
  std::size_t rays() const { return rays_; }

 private:
  void trace(const BareScene& scene) {
    if (work_.one_origin) {
      bare_.intersect16(scene, hits_, work_.coherent);
    } else {
      bare_.occluded16(scene, blocked_.data(), work_.coherent);
    }
  }

  std::size_t rays_;
  Workload work_;
  BareRays bare_;
  Hits hits_;
  std::vector<std::uint8_t> blocked_;
};

void frames(benchmark::State& state, int threads, const Work& frame) {
  tbb::task_arena arena(threads);
  arena.execute([&] {
    frame();
    for (auto _ : state) state.SetIterationTime(wall_seconds(frame));
  });
  state.counters["frames/s"] =
      benchmark::Counter(double(state.iterations()), benchmark::Counter::kIsRate);
}

void depth_frames(benchmark::State& state, const Setting& s, const StereoSensor& sensor,
                  int threads) {
  std::uint64_t seed = 0;
  frames(state, threads, [&] {
    benchmark::DoNotOptimize(simulate_depth(s.scene.rays(), s.camera, sensor, seed++));
  });
}

void color_frames(benchmark::State& state, const Setting& s, int threads) {
  std::uint64_t seed = 0;
  frames(state, threads,
         [&] { benchmark::DoNotOptimize(simulate_color(s.scene, {}, s.camera, {}, seed++)); });
}

/// Our frame against all of its rays by Embree alone, `repeats` times each part, in turns on one
/// thread.
void against_bare(benchmark::State& state, const Setting& s, std::vector<BarePart> parts,
                  int repeats, const Work& ours) {
  const auto bare_seconds = [&] {
    double seconds = 0;
    for (BarePart& part : parts) seconds += repeats * part.seconds_of_all(s.bare);
    return seconds;
  };
  std::vector<double> rates;
  tbb::task_arena one(1);
  one.execute([&] {
    ours(), bare_seconds();
    for (auto _ : state) {
      const double own = thread_seconds(ours);
      rates.push_back(bare_seconds() / own);
      state.SetIterationTime(own);
    }
  });
  std::size_t rays = 0;
  for (const BarePart& part : parts) rays += std::size_t(repeats) * part.rays();
  state.SetItemsProcessed(state.iterations() * std::int64_t(rays));
  state.counters["part_of_bare_rate"] = median(rates);
}

void depth_against_bare(benchmark::State& state, const Setting& s) {
  const Workload first = first_rays(s);
  const StereoSensor sensor;
  std::vector<BarePart> parts;
  parts.emplace_back(first);
  parts.emplace_back(device_rays(s, first, sensor.noise.baseline_m));
  parts.emplace_back(device_rays(s, first, sensor.projector_m));
  std::uint64_t seed = 0;
  against_bare(state, s, std::move(parts), 1, [&] {
    benchmark::DoNotOptimize(simulate_depth(s.scene.rays(), s.camera, sensor, seed++));
  });
}

void color_against_bare(benchmark::State& state, const Setting& s) {
  const Workload first = sample_rays(s);
  const ColorSensor sensor;
  std::vector<BarePart> parts;
  parts.emplace_back(first);
  parts.emplace_back(lamp_rays(s, first));
  parts.emplace_back(sky_rays(s, first));
  std::uint64_t seed = 0;
  against_bare(state, s, std::move(parts), sensor.samples_per_pixel, [&] {
    benchmark::DoNotOptimize(simulate_color(s.scene, {}, s.camera, sensor, seed++));
  });
}

}  // namespace
}  // namespace vantage::bench

int main(int argc, char** argv) {
  using namespace vantage::bench;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  const Setting setting;
  const auto add = [](const char* name, const auto& run) {
    benchmark::RegisterBenchmark(name, run)->UseManualTime()->Unit(benchmark::kMillisecond);
  };
  const vantage::StereoSensor noisy, exact = vantage::StereoSensor::ideal();
  add("depth 640x480, D435, 2 threads",
      [&](benchmark::State& state) { depth_frames(state, setting, noisy, 2); });
  add("depth 640x480, ideal, 2 threads",
      [&](benchmark::State& state) { depth_frames(state, setting, exact, 2); });
  add("depth 640x480, D435, 1 thread against bare Embree",
      [&](benchmark::State& state) { depth_against_bare(state, setting); });
  add("color 640x480, 16 samples, 2 threads",
      [&](benchmark::State& state) { color_frames(state, setting, 2); });
  add("color 640x480, 16 samples, 1 thread against bare Embree",
      [&](benchmark::State& state) { color_against_bare(state, setting); });
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
