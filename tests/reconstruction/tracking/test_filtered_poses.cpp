#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "reconstruction/tracking/moving_scene.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

MovingScene standing_scene(std::uint32_t seed) {
  MovingScene scene(seed, 3, 1);
  scene.objects = {scene.at(0, 0, 0, 0.4)};
  return scene;
}

/// Standard deviation of the x coordinate over time, of the last `count` snapshots.
double jitter(MovingScene& scene, ObjectTracker& tracker, int before, int count) {
  for (int i = 0; i < before; ++i) scene.see(tracker);
  double sum = 0, squares = 0;
  for (int i = 0; i < count; ++i) {
    const TrackedScene seen = scene.see(tracker);
    REQUIRE(seen.objects.size() == 1);
    const double x = seen.objects[0].T_world_object.translation().x();
    sum += x;
    squares += x * x;
  }
  return std::sqrt(std::max(0.0, squares / count - sum * sum / count / count));
}

double jitter_with(TemporalFilter filter, std::uint32_t seed) {
  MovingScene scene = standing_scene(seed);
  ObjectTracker tracker = scene.tracker({.filter = filter});
  return jitter(scene, tracker, int(scene_count(40)), int(scene_count(60)));
}

}  // namespace

TEST_CASE("tracking: the poses of standing objects jitter four times less than snapshots'") {
  double none = 0, kalman = 0, features = 0;
  for (std::uint32_t seed = 1; seed <= scene_count(6); ++seed) {
    none += jitter_with(TemporalFilter::none, seed);
    kalman += jitter_with(TemporalFilter::kalman, seed);
    features += jitter_with(TemporalFilter::features, seed);
  }
  MESSAGE("jitter of none / kalman " << none / kalman << ", of none / features "
                                     << none / features);
  CHECK((none > 4 * kalman || !kAllScenes));  // one scene proves little
  CHECK((none > 1.5 * features || !kAllScenes));
}

TEST_CASE("tracking: the covariance of filtered poses is true, cameras that are off included" *
          doctest::skip(kSanitized)) {
  const std::uint32_t trials = scene_count(400);
  double sum = 0;
  std::uint32_t count = 0;
  for (std::uint32_t seed = 1; count < trials; ++seed) {
    REQUIRE(seed < 3 * trials + 10);
    MovingScene scene = standing_scene(seed);
    std::vector<CameraView> known = scene.cameras;
    for (CameraView& view : known) {  // where they are taken to be
      view.covariance.diagonal() << Eigen::Vector3d::Constant(1e-6),
          Eigen::Vector3d::Constant(4e-6);
      view.T_world_cam = moved_by(*view.T_world_cam, normal_vector(scene.random, 0.001),
                                  normal_vector(scene.random, 0.002));
    }
    ObjectTracker tracker = scene.tracker();
    TrackedScene last;
    for (int i = 0; i < 10; ++i) {
      std::vector<CameraView> views = scene.cameras;
      look_at(views, scene.objects, scene.noise, scene.random);
      for (std::size_t v = 0; v < views.size(); ++v) {
        views[v].T_world_cam = known[v].T_world_cam;
        views[v].covariance = known[v].covariance;
      }
      last = tracker.update({double(i), views});
    }
    // One marker in one view has no Gaussian errors: it has a flip.
    if (last.objects.size() != 1 || last.objects[0].support.size() < 3) continue;
    ++count;
    const auto error = difference(last.objects[0].T_world_object, scene.objects[0].T_world_object);
    sum += error.dot(last.objects[0].covariance.llt().solve(error));
  }
  const double nees = sum / trials;
  MESSAGE("NEES " << nees << " over " << trials << " trials");
  CHECK((std::abs(nees - 6) < 1.96 * std::sqrt(12.0 / trials) || !kAllScenes));
}

TEST_CASE("tracking: what all pictures have in common does not average away") {
  MovingScene scene = standing_scene(3);
  for (CameraView& view : scene.cameras) {
    view.covariance.diagonal() << Eigen::Vector3d::Constant(4e-6), Eigen::Vector3d::Constant(4e-6);
  }
  ObjectTracker tracker = scene.tracker();
  TrackedScene first = scene.see(tracker), last;
  for (int i = 0; i < 100; ++i) last = scene.see(tracker);
  REQUIRE(first.objects.size() == 1);
  REQUIRE(last.objects.size() == 1);
  const double common = 4e-6 / double(scene.cameras.size());  // at least, of each coordinate
  CHECK(last.objects[0].covariance(0, 0) > 0.5 * common);
  CHECK(last.objects[0].covariance(0, 0) < first.objects[0].covariance(0, 0));
}

TEST_CASE("tracking: a pose has settled three snapshots after a move" * doctest::skip(kSanitized)) {
  for (const auto filter : {TemporalFilter::kalman, TemporalFilter::features}) {
    MovingScene scene = standing_scene(4);
    ObjectTracker tracker = scene.tracker({.filter = filter});
    for (int i = 0; i < 50; ++i) scene.see(tracker);
    scene.objects = {scene.at(0, 0.02, 0.01, 0.5)};
    TrackedScene last;
    for (int i = 0; i < 3; ++i) last = scene.see(tracker);
    REQUIRE(last.objects.size() == 1);
    const PoseError error = pose_error(*scene.objects[0].type, last.objects[0].T_world_object,
                                       scene.objects[0].T_world_object);
    CHECK(error.m < 0.002);
    CHECK(error.rad < 0.02);
  }
}

}  // namespace vantage::test
