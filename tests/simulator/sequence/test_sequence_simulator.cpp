#include "simulator/sequence/sequence_simulator.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "simulator/placement/collision.hpp"
#include "simulator/sequence/sequence_scenes.hpp"
#include "support/expect_error.hpp"

namespace vantage::test {
namespace {

using doctest::Approx;

std::vector<Eigen::Vector2d> all_pixels(const SimulatedInstant& instant) {
  std::vector<Eigen::Vector2d> pixels;
  for (const CameraView& view : instant.views) {
    for (const Observation& seen : view.observations) {
      const auto& points = std::get<SeenPoints>(seen.data).pixels;
      pixels.insert(pixels.end(), points.begin(), points.end());
    }
  }
  return pixels;
}

SequenceSimulator simulator_of(const SequenceScene& scene, SequencePlan plan,
                               const FeatureSensor& sensor, std::uint64_t seed = 3) {
  return SequenceSimulator(std::move(plan), scene.fixed, scene.cameras, sensor, seed);
}

}  // namespace

TEST_CASE("corners have the stated noise, and the same seed the same") {
  const SequenceScene scene = six_cubes();
  const SequencePlan plan{.instants = 20, .objects = scene.objects};
  const auto noisy = simulator_of(scene, plan, {.sigma_px = 0.2, .depth_width = 0});
  const auto exact = simulator_of(scene, plan, {.sigma_px = 1e-9, .depth_width = 0});
  double sum = 0;
  std::size_t count = 0;
  for (int i = 0; i < 5; ++i) {
    const auto a = all_pixels(noisy.at(i)), b = all_pixels(exact.at(i));
    CHECK(a == all_pixels(noisy.at(i)));
    REQUIRE(a.size() == b.size());  // the draws of recall are the same
    for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]).squaredNorm();
    count += 2 * a.size();
  }
  CHECK(count > 500);
  CHECK(std::sqrt(sum / double(count)) == Approx(0.2).epsilon(0.1));
  CHECK(all_pixels(noisy.at(0)) != all_pixels(noisy.at(1)));
}

TEST_CASE("a camera out of step sees an object where it is later") {
  const SequenceScene scene = six_cubes();
  SequencePlan plan{.instants = 20, .camera_delay_s = {0, 0.5}};
  plan.objects = {scene.objects[0]};
  plan.objects[0].stays = {
      {.to_s = 0.3, .T_world_object = scene.objects[0].stays[0].T_world_object},
      {.from_s = 0.4, .T_world_object = Pose::from_translation({0.1, 0.1, 0.025})}};
  const auto simulator = simulator_of(scene, plan, {.sigma_px = 1e-9, .depth_width = 0});
  const SimulatedInstant now = simulator.at(0);
  plan.camera_delay_s = {};
  const auto in_step = simulator_of(scene, plan, {.sigma_px = 1e-9, .depth_width = 0});
  const SimulatedInstant later = in_step.at(5);
  const auto first_pixel = [](const CameraView& view) {
    REQUIRE_FALSE(view.observations.empty());
    return std::get<SeenPoints>(view.observations[0].data).pixels[0];
  };
  CHECK((first_pixel(now.views[0]) - first_pixel(in_step.at(0).views[0])).norm() < 1e-6);
  CHECK((first_pixel(now.views[1]) - first_pixel(later.views[1])).norm() < 1e-6);
  CHECK((first_pixel(now.views[1]) - first_pixel(in_step.at(0).views[1])).norm() > 20);
}

TEST_CASE("depth images are coarse and show the objects") {
  const SequenceScene scene = six_cubes();
  const SequencePlan plan{.instants = 1, .objects = scene.objects};
  const SimulatedInstant instant = simulator_of(scene, plan, {}).at(0);
  REQUIRE(instant.depth.size() == 3);
  const DepthCamera& camera = instant.depth[0];
  CHECK(camera.depth->width() == 160);
  CHECK(camera.depth->height() == 120);
  const Eigen::Vector3d top =
      scene.objects[1].stays[0].T_world_object * Eigen::Vector3d(0, 0, 0.025);
  const auto pixel = camera.camera.project(top);
  CHECK(double(camera.depth->at(int(std::lround(pixel->u)), int(std::lround(pixel->v)))) ==
        Approx(pixel->depth).epsilon(0.03));
}

TEST_CASE("sensors without sense are refused") {
  const SequenceScene scene = six_cubes();
  const SequencePlan plan{.instants = 1, .objects = scene.objects};
  expect_error(ErrorCode::bad_input, "sigma_px", "",
               [&] { simulator_of(scene, plan, {.sigma_px = 0}); });
  expect_error(ErrorCode::bad_input, "depth_width", "",
               [&] { simulator_of(scene, plan, {.depth_width = -1}); });
}

TEST_CASE("random sequences have the events that were asked for, one after the other") {
  const SequenceScene scene = six_cubes();
  const RandomSequence options{.instants = 120, .moves = 6, .added = 2, .taken_away = 1, .seed = 4};
  const SequencePlan plan = random_sequence(scene, options);
  std::size_t moves = 0, ended = 0;
  for (const SequenceObject& object : plan.objects) {
    moves += object.stays.size() - 1;
    ended += std::isfinite(object.stays.back().to_s);
  }
  CHECK(moves == 6);
  CHECK(plan.objects.size() == 8);
  CHECK(ended == 1);
  const SequencePlan again = random_sequence(scene, options);
  for (std::size_t i = 0; i < plan.objects.size(); ++i) {
    CHECK(plan.objects[i].stays.back().T_world_object.translation() ==
          again.objects[i].stays.back().T_world_object.translation());
  }
}

TEST_CASE("objects that stand in a random sequence never touch, and are likely seen") {
  const SequenceScene scene = six_cubes();
  const SequencePlan plan = random_sequence(scene, {.instants = 150, .moves = 10, .seed = 8});
  const CollisionShape shape(*scene.objects[0].type->mesh);
  for (int i = 0; i < plan.instants; i += 3) {
    const SequenceMoment moment = moment_at(plan, plan.time_s(i));
    for (std::size_t a = 0; a < moment.objects.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        if (moment.objects[a].carried || moment.objects[b].carried) continue;
        CHECK_FALSE(closer_than(0.001, shape, moment.objects[a].T_world_object, shape,
                                moment.objects[b].T_world_object));
      }
    }
  }
  for (const SequenceObject& object : plan.objects) {
    if (object.stays.size() < 2) continue;
    const SequenceMoment last = moment_at(plan, 1e3);
    CHECK(likely_seen(*object.type, object.stays.back().T_world_object, scene.cameras,
                      *scene_of(plan, {last.objects, {}}, scene.fixed)));
  }
}

TEST_CASE("the arm hides markers in some instants, and none where it is drawn back") {
  const SequenceScene scene = six_cubes();
  const RandomSequence options{.instants = 100, .moves = 3, .seed = 2};
  const SequencePlan with_arm = random_sequence(scene, options);
  SequencePlan without = with_arm;
  without.arm.reset();
  const FeatureSensor sensor{.sigma_px = 0.1, .depth_width = 0};
  const auto a = simulator_of(scene, with_arm, sensor), b = simulator_of(scene, without, sensor);
  CHECK(all_pixels(a.at(0)) == all_pixels(b.at(0)));
  int fewer = 0;
  for (int i = 0; i < 100; ++i) {
    const std::size_t seen = all_pixels(a.at(i)).size(), all = all_pixels(b.at(i)).size();
    CHECK(seen <= all);
    fewer += seen < all;
  }
  CHECK(fewer > 10);
  CHECK(fewer < 90);
}

TEST_CASE("more events than there is time for are refused") {
  expect_error(ErrorCode::bad_input, "instants", "",
               [] { random_sequence(six_cubes(), {.instants = 20, .moves = 10}); });
}

}  // namespace vantage::test
