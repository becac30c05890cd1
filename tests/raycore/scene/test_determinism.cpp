// The same batch gives the same bits at any number of threads.

#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <cstring>
#include <limits>
#include <thread>
#include <vector>

#include "reference/random_scene.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

constexpr std::size_t kRays = 100000;
constexpr int kThreads[] = {1, 2, 3, 8};

/// Runs `action` in an arena of so many threads, even where the machine has fewer cores.
template <class Action>
void with_threads(int threads, const Action& action) {
  const tbb::global_control really(tbb::global_control::max_allowed_parallelism, 8);
  tbb::task_arena(threads).execute(action);
}

template <class T>
bool same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

bool same_bits(const Hits& a, const Hits& b) {
  return same_bits(a.t, b.t) && same_bits(a.u, b.u) && same_bits(a.v, b.v) &&
         same_bits(a.object, b.object) && same_bits(a.triangle, b.triangle) &&
         same_bits(a.normal.x, b.normal.x) && same_bits(a.normal.y, b.normal.y) &&
         same_bits(a.normal.z, b.normal.z);
}

/// Enough triangles that Embree builds in parallel.
std::shared_ptr<const Scene> large_scene(bool with_instances) {
  Random random(42);
  SceneBuilder builder;
  builder.add_mesh(height_field_block(random, 120));
  builder.add_mesh(triangle_soup(random, 2000));
  const auto ball = std::make_shared<TriangleMesh>(icosphere(0.1, 3));
  for (int i = 0; with_instances && i < 40; ++i) builder.add_instance(ball, random.pose(1));
  return builder.build();
}

struct Answers {
  Hits hits, from_eye;
  std::vector<std::uint8_t> pairs = std::vector<std::uint8_t>(kRays);
  std::vector<std::uint8_t> to_eye = std::vector<std::uint8_t>(kRays);
  std::vector<float> depth;
};

Points random_points(std::uint32_t seed) {
  Random random(seed);
  Points points(kRays);
  for (std::size_t i = 0; i < kRays; ++i) points.set(i, random.in_cube(1.2).cast<float>());
  return points;
}

Answers ask(const Scene& scene, RayOrder order) {
  static const Points a = random_points(8), b = random_points(9);
  const Eigen::Vector3d eye(0.9, -1.1, 1.3);
  Answers answers;
  scene.closest_hits(a, b, answers.hits, order);
  scene.closest_hits(eye.cast<float>(), b, answers.from_eye, order);
  scene.occluded(a, b, answers.pairs, order);
  scene.occluded(a, eye.cast<float>(), answers.to_eye, order);
  const PinholeCamera camera({333, 251, 300, 300, 166, 125}, Pose::looking_at(eye, {0, 0, 0}));
  const DepthImage depth = scene.render_depth(camera);
  answers.depth.assign(depth.metres().begin(), depth.metres().end());
  return answers;
}

void expect_same(const Answers& a, const Answers& b) {
  CHECK(same_bits(a.hits, b.hits));
  CHECK(same_bits(a.from_eye, b.from_eye));
  CHECK(same_bits(a.pairs, b.pairs));
  CHECK(same_bits(a.to_eye, b.to_eye));
  CHECK(same_bits(a.depth, b.depth));
}

}  // namespace

TEST_CASE("1, 2, 3 and 8 threads give the same bits") {
  for (const bool with_instances : {false, true}) {
    const auto scene = large_scene(with_instances);
    for (const RayOrder order : {RayOrder::incoherent, RayOrder::coherent}) {
      std::vector<Answers> all;
      for (const int threads : kThreads) {
        with_threads(threads, [&] { all.push_back(ask(*scene, order)); });
      }
      CAPTURE(with_instances);
      for (std::size_t i = 1; i < all.size(); ++i) expect_same(all[0], all[i]);
    }
  }
}

TEST_CASE("a scene built at another number of threads gives the same depths and occlusion") {
  for (const bool with_instances : {false, true}) {
    std::vector<Answers> all;
    for (const int threads : kThreads) {
      with_threads(threads,
                   [&] { all.push_back(ask(*large_scene(with_instances), RayOrder::incoherent)); });
    }
    CAPTURE(with_instances);
    for (std::size_t i = 1; i < all.size(); ++i) {
      CHECK(same_bits(all[0].hits.t, all[i].hits.t));
      CHECK(same_bits(all[0].from_eye.t, all[i].from_eye.t));
      CHECK(same_bits(all[0].pairs, all[i].pairs));
      CHECK(same_bits(all[0].to_eye, all[i].to_eye));
      CHECK(same_bits(all[0].depth, all[i].depth));
    }
  }
}

TEST_CASE("many threads may ask one scene at once") {
  const auto scene = random_scene(5, true).scene;
  static constexpr std::size_t kSmall = 1000;  // one block: traced by the thread that asks
  Random random(6);
  Points a(kSmall), b(kSmall);
  for (std::size_t i = 0; i < kSmall; ++i) {
    a.set(i, random.in_cube(1.2).cast<float>());
    b.set(i, random.in_cube(1.2).cast<float>());
  }
  std::vector<Hits> hits(8);
  std::vector<std::vector<std::uint8_t>> occluded(8, std::vector<std::uint8_t>(kSmall));
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < hits.size(); ++t) {
    threads.emplace_back([&, t] {
      for (int again = 0; again < 5; ++again) {
        scene->closest_hits(a, b, hits[t]);
        scene->occluded(a, b, occluded[t]);
        (void)scene->closest_hit({a[t], b[t]});
        (void)scene->occluded(a[t], b[t]);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (std::size_t t = 1; t < hits.size(); ++t) {
    CHECK(same_bits(hits[0], hits[t]));
    CHECK(same_bits(occluded[0], occluded[t]));
  }
}

TEST_CASE("a bad ray is named alike at any number of threads") {
  const auto scene = large_scene(false);
  Points a(kRays), b(kRays);
  b.x.assign(kRays, 1);
  for (const std::size_t i : {70001, 70000, 99999, 55555}) {
    a.y[i] = std::numeric_limits<float>::quiet_NaN();
  }
  for (const int threads : kThreads) {
    with_threads(threads, [&] {
      Hits hits;
      std::vector<std::uint8_t> result(kRays);
      CHECK_THROWS_WITH(scene->closest_hits(a, b, hits), doctest::Contains("ray 55555:"));
      CHECK_THROWS_WITH(scene->occluded(a, b, result), doctest::Contains("segment 55555:"));
    });
  }
}
