#include <doctest/doctest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "reconstruction/synthetic_views.hpp"
#include "support/scene_count.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

using namespace vantage;
using namespace vantage::test;

namespace {

/// The mean normalised squared error of poses over many trials with the same noise, each trial with
/// another object among other cameras. With a true covariance it is 6 on average.
double mean_nees(const ViewNoise& noise, std::uint32_t trials, int cameras) {
  const MemoryKnowledgeBase knowledge({marked_box("box", {0.06, 0.05, 0.07}, 0)});
  double sum = 0;
  std::uint32_t count = 0;
  for (std::uint32_t seed = 1; count < trials; ++seed) {
    REQUIRE(seed < 2 * trials + 10);
    Random random(seed);
    auto views = cameras_around(random, cameras);
    const auto objects = scattered(random, knowledge.types(), 1, 0.15);
    look_at(views, objects, noise, random);
    const Reconstruction result = reconstruct_pnp(views, knowledge);
    // One marker in one view has no Gaussian errors: it has a flip.
    if (result.objects.size() != 1 || result.objects[0].support.size() < 3) continue;
    const auto& found = result.objects[0];
    const auto error = difference(found.T_world_object, objects[0].T_world_object);
    sum += error.dot(found.covariance->llt().solve(error));
    ++count;
  }
  return sum / count;
}

/// Where the mean of so many trials lies in 95 of 100 cases: a sum of chi-squares with six degrees
/// of freedom each, whose variance is 12.
void expect_true_covariance(const ViewNoise& noise, int cameras) {
  const std::uint32_t trials = scene_count(1000);
  const double nees = mean_nees(noise, trials, cameras);
  MESSAGE("NEES " << nees << " over " << trials << " trials");
  if (kAllScenes) CHECK(std::abs(nees - 6) < 1.96 * std::sqrt(12.0 / trials));
}

}  // namespace

TEST_CASE("PnP: the covariance is true, with exact cameras") {
  expect_true_covariance({.sigma_px = 0.3}, 4);
}

TEST_CASE("PnP: the covariance is true, with cameras that are off as their covariances say") {
  expect_true_covariance({.sigma_px = 0.2, .camera_m = 0.001, .camera_rad = 0.002}, 4);
}

TEST_CASE("PnP: the covariance is true, with cameras that are slightly off") {
  expect_true_covariance({.sigma_px = 0.3, .camera_m = 0.0001, .camera_rad = 0.0002}, 3);
}

TEST_CASE("PnP: residuals beyond the noise make the covariance larger") {
  const MemoryKnowledgeBase knowledge({marked_box("box", {0.06, 0.05, 0.07}, 0)});
  Random random(4);
  auto views = cameras_around(random, 5);
  const auto objects = scattered(random, knowledge.types(), 1, 0.1);
  look_at(views, objects, {.sigma_px = 0.8}, random);
  for (CameraView& view : views) {
    for (Observation& o : view.observations) std::get<SeenPoints>(o.data).sigma_px = 0.1;
  }
  const Reconstruction result = reconstruct_pnp(views, knowledge);
  REQUIRE(result.objects.size() == 1);
  const auto error = difference(result.objects[0].T_world_object, objects[0].T_world_object);
  CHECK(error.dot(result.objects[0].covariance->llt().solve(error)) < 22.5);  // 99.9 %
}
