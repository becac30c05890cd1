#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "planner/wall_world.hpp"
#include "support/expect_error.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

/// The wall, and the floor around it, as the camera in front measures them.
WorldModel measured_wall(bool recognised) {
  WorldModel world = test::wall_world();
  WorldModel all = world;
  all.static_structures.push_back(
      {"floor",
       std::make_shared<const TriangleMesh>(TriangleMesh::from_box(Box({-5, -5, -0.1}, {5, 5, 0}))),
       {}});
  const PinholeCamera& camera = world.cameras[0].camera;
  world.cameras[0].depth =
      std::make_shared<const DepthImage>(known_scene(all)->render_depth(camera));
  if (!recognised) world.objects.clear();
  return world;
}

MeshMethod& mesh_of(PlanRequest& request) {
  return std::get<MeshMethod>(request.method);
}

PlanRequest mesh_request() {
  PlanRequest request = test::small_request();
  request.method = MeshMethod{.visibility = {.step_px = 2}, .image_width = 64};
  request.servo = {3, 64};
  request.candidates = HalfSpheres{{0.45, 0.6}, {24}, {}};
  request.polish.views = 0;  // what is polished is better than any candidate's servoing
  return request;
}

Score best_exact_of_all(const WorldModel& world, const Plan& plan) {
  Score best = 0;
  for (const ScoredCandidate& candidate : plan.candidates) {
    for (const ScoredStep& step : explain_view(world, plan, candidate.view.id).trace) {
      REQUIRE(step.score.exact());
      best = std::max(best, step.score.score);
    }
  }
  return best;
}

}  // namespace

TEST_CASE("the mesh method looks at the other side, whether the wall was recognised or not") {
  for (const bool recognised : {true, false}) {
    CAPTURE(recognised);
    const WorldModel world = measured_wall(recognised);
    const Plan plan = plan_next_view(world, mesh_request());
    REQUIRE(plan.best() != nullptr);
    CHECK(plan.best()->T_world_cam.translation().y() > 0.1);  // the camera is at -0.6
    CHECK(plan.best()->score == best_exact_of_all(world, plan));
    CHECK(plan.trace.size() > 1);
    CHECK(plan.trace[std::size_t(plan.best()->servo_iteration)].score.score == plan.best()->score);
  }
}

TEST_CASE("the request's noise is the mesh method's, too") {
  const WorldModel world = measured_wall(true);
  PlanRequest request = mesh_request();
  std::vector<Score> scores;
  for (const double subpixel_px : {0.08, 0.8}) {
    request.volume.noise.subpixel_px = subpixel_px;
    scores.push_back(plan_next_view(world, request).best()->score);
  }
  CHECK(scores[0] != scores[1]);
}

TEST_CASE("a shortlist that all candidates are on finds what scoring all of them finds") {
  const WorldModel world = measured_wall(true);
  PlanRequest request = mesh_request();
  mesh_of(request).exact_views = 0;
  mesh_of(request).shortlist_voxel_m = 0.01;
  mesh_of(request).shortlist = 1000;
  const Plan plan = plan_next_view(world, request);
  REQUIRE(plan.best() != nullptr);
  CHECK(plan.best()->score == best_exact_of_all(world, plan));
  CHECK(plan.finished == plan.candidates.size());
  CHECK(plan.stopped == StopReason::none);
}

TEST_CASE("what is not on the shortlist is passed over, and the best is the best of those on it") {
  const WorldModel world = measured_wall(true);
  PlanRequest request = mesh_request();
  mesh_of(request).exact_views = 0;
  mesh_of(request).shortlist_voxel_m = 0.01;
  mesh_of(request).shortlist = 4;
  request.search.ranked = 3;
  const Plan plan = plan_next_view(world, request);
  std::size_t exact = 0, pruned = 0;
  Score best = 0;
  for (const ScoredCandidate& candidate : plan.candidates) {
    if (candidate.rejected != InvalidReason::none) continue;
    if (candidate.score.exact()) {
      ++exact;
      best = std::max(best, candidate.score.score);
    }
    if (candidate.score.known == ScoreBound::Known::pruned) ++pruned;
  }
  CHECK(plan.ranked.size() == 3);
  CHECK(exact >= 3);
  CHECK(pruned > exact);
  CHECK(plan.best()->score == best);
  CHECK(plan.finished == plan.candidates.size());
}

TEST_CASE("a mesh plan is the same to the bit at any number of threads, shortlist or not") {
  const WorldModel world = measured_wall(false);
  for (const int exact_views : {0, 40000}) {
    PlanRequest request = mesh_request();
    mesh_of(request).exact_views = exact_views;
    mesh_of(request).shortlist_voxel_m = 0.01;
    const Plan one = tbb::task_arena(1).execute([&] { return plan_next_view(world, request); });
    for (const int threads : {2, 3, 8}) {
      const Plan many =
          tbb::task_arena(threads).execute([&] { return plan_next_view(world, request); });
      REQUIRE(many.ranked.size() == one.ranked.size());
      for (std::size_t i = 0; i < one.ranked.size(); ++i) {
        CHECK(many.ranked[i].candidate == one.ranked[i].candidate);
        CHECK(many.ranked[i].score == one.ranked[i].score);
        CHECK(many.ranked[i].T_world_cam.translation() == one.ranked[i].T_world_cam.translation());
      }
    }
  }
}

TEST_CASE("further views of the mesh method count what the views before will have seen") {
  const WorldModel world = measured_wall(true);
  PlanRequest request = mesh_request();
  request.views.most = 3;
  request.intrinsics = {64, 48, 250, 250, 31.5, 23.5};  // so narrow that one view leaves a part
  const Plan plan = plan_next_view(world, request);
  REQUIRE(plan.views.size() >= 2);
  CHECK(
      (plan.views[0].view.T_world_cam.translation() - plan.views[1].view.T_world_cam.translation())
          .norm() > 0.05);
  CHECK(plan.views[1].view.score < plan.views[0].view.score);
}

TEST_CASE("depth images that say nothing: a plan or a clear reason") {
  WorldModel world = measured_wall(false);
  const PlanRequest request = mesh_request();
  const auto planned = [&](std::vector<float> depths) {
    world.cameras[0].depth = std::make_shared<const DepthImage>(64, 48, std::move(depths));
    return plan_next_view(world, request);
  };
  const std::size_t pixels = 64 * 48;
  for (const float value : {0.0f, DepthImage::kUnknown}) {  // nothing measured: all is unseen
    const Plan plan = planned(std::vector<float>(pixels, value));
    REQUIRE(plan.best() != nullptr);
  }
  std::vector<float> holes(pixels, DepthImage::kUnknown);
  for (std::size_t i = 0; i < pixels; i += 10) holes[i] = 0.5f;
  CHECK(planned(holes).best() != nullptr);
  world.cameras.push_back(world.cameras[0]);  // the same one twice
  CHECK(planned(std::vector<float>(pixels, 0.5f)).best() != nullptr);
  world.cameras[1].camera = world.cameras[1].camera.moved_to(
      Pose::looking_at({0, 0, 0.1}, {0, 0.1, 0.1}));  // inside the work area
  world.cameras[1].depth =
      std::make_shared<const DepthImage>(64, 48, std::vector<float>(pixels, 1));
  CHECK(plan_next_view(world, request).best() != nullptr);
  world.cameras[1].camera =
      world.cameras[1].camera.moved_to(Pose::looking_at({0, 3, 0.1}, {0, 4, 0.1}));  // looks away
  CHECK(plan_next_view(world, request).best() != nullptr);
  world.cameras[0].depth = world.cameras[1].depth = nullptr;
  test::expect_bad_input("method", "none of the 2 cameras has one",
                         [&] { (void)plan_next_view(world, request); });
}

}  // namespace vantage
