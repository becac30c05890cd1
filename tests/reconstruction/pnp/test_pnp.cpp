#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <cstring>
#include <optional>

#include "reconstruction/synthetic_views.hpp"
#include "support/scene_count.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

MemoryKnowledgeBase boxes() {
  return MemoryKnowledgeBase({marked_box("cube", {0.05, 0.05, 0.05}, 0),
                              marked_box("brick", {0.08, 0.05, 0.04}, 6),
                              marked_box("tower", {0.05, 0.06, 0.1}, 12)});
}

/// Found poses as bytes: -0 and 0 differ, and so do any two NaNs.
std::string bytes_of(const Reconstruction& result) {
  std::string bytes;
  const auto add = [&](const double* values, Eigen::Index count) {
    bytes.append(reinterpret_cast<const char*>(values), std::size_t(count) * sizeof(double));
  };
  for (const ReconstructedObject& object : result.objects) {
    bytes += object.type->name;
    add(object.T_world_object.rotation().data(), 9);
    add(object.T_world_object.translation().data(), 3);
    add(object.covariance->data(), 36);
    add(&object.probability, 1);
    for (const Support& support : object.support) {
      bytes += std::to_string(support.id.view) + "/" + std::to_string(support.id.observation);
      add(&support.residual_px, 1);
    }
    for (const Alternative& other : object.alternatives) add(&other.probability, 1);
  }
  for (const Unexplained& rest : result.unexplained) bytes += rest.reason;
  return bytes;
}

/// The error of the only object, if there is one.
std::optional<double> error_m(const Reconstruction& result, const PlacedObject& truth) {
  if (result.objects.size() != 1) return std::nullopt;
  return pose_error(*truth.type, result.objects[0].T_world_object, truth.T_world_object).m;
}

}  // namespace

TEST_CASE("PnP: exact corners give exact poses, of all objects") {
  const MemoryKnowledgeBase knowledge = boxes();
  for (std::uint32_t seed = 1; seed <= scene_count(30); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    auto views = cameras_around(random, 4);
    const auto objects = scattered(random, knowledge.types(), 5, 0.2);
    const auto owners = look_at(views, objects, {.sigma_px = 0}, random);
    const Reconstruction result = reconstruct_pnp(views, knowledge);
    CHECK(result.unexplained.empty());
    CHECK(result.stopped == StopReason::none);
    for (const ReconstructedObject& found : result.objects) {
      const ObservationId first = found.support.front().id;
      const int owner = owners[first.view][first.observation];
      for (const Support& support : found.support) {
        CHECK(owners[support.id.view][support.id.observation] == owner);
        CHECK(support.residual_px < 1e-3);
        const Observation& seen = views[support.id.view].observations[support.id.observation];
        CHECK(found.type->features[support.feature].key == seen.key);
      }
      const PlacedObject& truth = objects[std::size_t(owner)];
      CHECK(found.type == truth.type);
      const PoseError error = pose_error(*truth.type, found.T_world_object, truth.T_world_object);
      CHECK(error.m < 1e-6);
      CHECK(error.rad < 1e-5);
    }
  }
}

TEST_CASE("PnP: better than SVD with any number of cameras, and better with more of them") {
  const MemoryKnowledgeBase knowledge({marked_box("cube", {0.05, 0.05, 0.05}, 0)});
  double before = 1;
  for (int cameras = 2; cameras <= 9; ++cameras) {
    CAPTURE(cameras);
    double pnp = 0, svd = 0;
    std::uint32_t scenes = 0;
    for (std::uint32_t seed = 1; seed <= scene_count(60); ++seed) {
      Random random(seed);
      const auto objects = scattered(random, knowledge.types(), 1, 0.1);
      auto views = cameras_around(random, cameras);
      look_at(views, objects, {.sigma_px = 0.3}, random);
      const auto error_pnp = error_m(reconstruct_pnp(views, knowledge), objects[0]);
      const auto error_svd = error_m(reconstruct_svd(views, knowledge), objects[0]);
      if (!error_pnp || !error_svd) continue;
      ++scenes;
      pnp += *error_pnp;
      svd += *error_svd;
    }
    REQUIRE(scenes >= scene_count(50));
    MESSAGE(cameras << " cameras: " << 1e3 * pnp / scenes << " mm, SVD " << 1e3 * svd / scenes);
    CHECK(pnp < 0.7 * svd);
    if (kAllScenes) CHECK(pnp / scenes < before);
    before = pnp / scenes;
  }
}

TEST_CASE("PnP: the same bits with any number of threads, and in any run") {
  const MemoryKnowledgeBase knowledge = boxes();
  Random random(11);
  auto views = cameras_around(random, 5);
  const auto objects = scattered(random, knowledge.types(), 12, 0.25);
  look_at(views, objects, {.missing = 0.3, .wrong_id = 0.1}, random);
  std::string first;
  for (const int threads : {1, 2, 3, 8, 1}) {
    CAPTURE(threads);
    tbb::task_arena arena(threads);
    const std::string bytes =
        arena.execute([&] { return bytes_of(reconstruct_pnp(views, knowledge)); });
    CHECK(bytes.size() > 1000);
    if (first.empty()) first = bytes;
    CHECK(bytes == first);
  }
}

TEST_CASE("PnP: objects in the order of the types, everything else ascending") {
  const MemoryKnowledgeBase knowledge = boxes();
  Random random(12);
  auto views = cameras_around(random, 4);
  const auto objects = scattered(random, knowledge.types(), 10, 0.25);
  look_at(views, objects, {.missing = 0.2, .wrong_id = 0.2}, random);
  const Reconstruction result = reconstruct_pnp(views, knowledge);
  REQUIRE(result.objects.size() > 5);
  REQUIRE(result.unexplained.size() > 2);
  std::pair<std::size_t, ObservationId> last{};
  std::vector<ObservationId> all;
  for (const ReconstructedObject& object : result.objects) {
    const auto& types = knowledge.types();
    const std::size_t rank =
        std::size_t(std::find(types.begin(), types.end(), object.type) - types.begin());
    const std::pair place{rank, object.support.front().id};
    CHECK(last <= place);
    last = place;
    for (const Support& support : object.support) all.push_back(support.id);
    CHECK(std::is_sorted(object.support.begin(), object.support.end(),
                         [](const auto& a, const auto& b) { return a.id < b.id; }));
  }
  CHECK(std::is_sorted(result.unexplained.begin(), result.unexplained.end(),
                       [](const auto& a, const auto& b) { return a.id < b.id; }));
  // Every observation is somewhere, once.
  for (const Unexplained& rest : result.unexplained) all.push_back(rest.id);
  std::sort(all.begin(), all.end());
  CHECK(std::adjacent_find(all.begin(), all.end()) == all.end());
  std::size_t observations = 0;
  for (const CameraView& view : views) observations += view.observations.size();
  CHECK(all.size() == observations);
}

TEST_CASE("PnP: a cancelled run says so, and lists what it did not process") {
  const MemoryKnowledgeBase knowledge = boxes();
  Random random(5);
  auto views = cameras_around(random, 2);
  look_at(views, scattered(random, knowledge.types(), 2, 0.1), {}, random);
  const StopToken stop;
  stop.cancel();
  const Reconstruction result = reconstruct_pnp(views, knowledge, {}, stop);
  CHECK(result.stopped == StopReason::cancelled);
  CHECK(result.objects.empty());
  REQUIRE_FALSE(result.unexplained.empty());
  CHECK(result.unexplained[0].reason.find("stopped") != std::string::npos);
}
