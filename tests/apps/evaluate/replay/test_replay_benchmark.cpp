#include "evaluate/replay/replay_benchmark.hpp"

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage::test {
namespace {

constexpr Intrinsics kSmall{64, 48, 60, 60, 31.5, 23.5};
const Box kReplayArea({-0.3, -0.3, 0}, {0.3, 0.3, 0.3});

/// A post and a low block on the floor, as cameras all around see them.
std::shared_ptr<const Scene> post_and_block() {
  SceneBuilder builder;
  builder.add_box(Box({-2, -2, -0.1}, {2, 2, 0}));
  builder.add_box(Box({-0.05, -0.05, 0}, {0.05, 0.05, 0.25}));
  builder.add_box(Box({0.12, 0.02, 0}, {0.25, 0.2, 0.1}));
  return builder.build();
}

PlanInput recording(const std::vector<Eigen::Vector3d>& eyes) {
  PlanInput input{{}, {.work_area = kReplayArea, .intrinsics = kSmall}, {}, {}};
  input.request.range = {0.02, 3};
  input.request.voxel_size_m = 0.03;
  const auto scene = post_and_block();
  for (std::size_t i = 0; i < eyes.size(); ++i) {
    const Pose pose = Pose::looking_at(eyes[i], {0, 0, 0.08});
    const PinholeCamera camera(kSmall, pose, input.request.range);
    input.world.cameras.push_back(
        {std::to_string(10 * i), camera,
         std::make_shared<const DepthImage>(scene->render_depth(camera))});
  }
  return input;
}

PlanInput all_around() {
  return recording({{0.9, 0, 0.4},
                    {0, 0.9, 0.5},
                    {-0.8, 0.1, 0.3},
                    {0.1, -0.9, 0.6},
                    {0.5, 0.5, 0.3},
                    {-0.6, -0.5, 0.4}});
}

ReplayBenchmarkOptions settings_for(const std::vector<std::string>& methods) {
  return {.methods = named_methods(methods), .pairs = 4};
}

std::size_t frame_index(int frame) {
  return std::size_t(frame) / 10;
}

WorldModel world_of(const PlanInput& input, const std::vector<int>& frames) {
  WorldModel world = input.world;
  world.cameras.clear();
  for (const int frame : frames) world.cameras.push_back(input.world.cameras[frame_index(frame)]);
  return world;
}

/// Voxels that are shadow in `before` and not in `after`; none may be the other way round.
std::size_t newly_known(const StateGrid& before, const StateGrid& after) {
  const Eigen::Vector3i size = before.geometry().size();
  std::size_t known = 0, lost = 0;
  for (int i = 0; i < size.x(); ++i) {
    for (int j = 0; j < size.y(); ++j) {
      for (int k = 0; k < size.z(); ++k) {
        const bool was = before.at({i, j, k}) == VoxelState::shadow;
        const bool is = after.at({i, j, k}) == VoxelState::shadow;
        known += std::size_t(was && !is);
        lost += std::size_t(!was && is);
      }
    }
  }
  CHECK(lost == 0);
  return known;
}

void expect_replay_refused(const PlanInput& input, const ReplayBenchmarkOptions& settings,
                           const char* where, const char* part) {
  try {
    evaluate_replay(input, settings);
    FAIL("nothing was thrown");
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::bad_input);
    CHECK(error.where() == where);
    CAPTURE(error.message());
    CHECK(error.message().find(part) != std::string::npos);
  }
}

}  // namespace

TEST_CASE("real gain: the voxels that are known with the frame's depth image, counted one by one") {
  PlanInput input = all_around();
  for (const bool anti_alias : {false, true}) {
    CAPTURE(anti_alias);
    input.request.volume.anti_alias = anti_alias;
    const auto evaluation = evaluate_replay(input, settings_for({"voxel"}));
    REQUIRE(evaluation.pairs.size() == 4);
    const auto geometry = GridGeometry::covering(kReplayArea, input.request.voxel_size_m);
    for (const ReplayPair& pair : evaluation.pairs) {
      const auto [a, b] = pair.frames;
      const auto before = classify(world_of(input, {a, b}), geometry, input.request.volume);
      CHECK(pair.shadow_m3 == before->volume_m3(VoxelState::shadow));
      REQUIRE(pair.views.size() == 4);
      for (const ReplayView& view : pair.views) {
        CHECK(view.frame != a);
        CHECK(view.frame != b);
        const auto after =
            classify(world_of(input, {a, b, view.frame}), geometry, input.request.volume);
        CHECK(view.real_gain_m3 ==
              double(newly_known(*before, *after)) * geometry.voxel_volume_m3());
      }
    }
  }
}

TEST_CASE("a method picks what a plan picks that has the frames' poses as its only candidates") {
  const PlanInput input = all_around();
  const ReplayBenchmarkOptions settings =
      settings_for({"voxel", "shadowD6", "shadowD0", "mesh", "meshD6"});
  for (const ReplayPair& pair : evaluate_replay(input, settings).pairs) {
    PlanRequest request = input.request;
    ViewList list;
    for (const ReplayView& view : pair.views) {
      list.poses.push_back(input.world.cameras[frame_index(view.frame)].camera.T_world_cam());
    }
    request.candidates = list;
    request.value = ViewValue::bound;
    request.volume.filter = FalseShadowFilter::off;
    request.servo.iterations = 0;
    request.polish.views = 0;
    const WorldModel two = world_of(input, {pair.frames[0], pair.frames[1]});
    for (std::size_t m = 0; m < settings.methods.size(); ++m) {
      CAPTURE(settings.methods[m].name);
      request.method = settings.methods[m].method;
      const Plan plan = plan_next_view(two, request);
      REQUIRE(plan.best() != nullptr);
      const ReplayView& pick = pair.views[pair.picks[m]];
      CHECK(pair.picks[m] == plan.best()->candidate);
      CHECK(pick.scores[m] == plan.in_units(plan.best()->score));
      CHECK(pick.predicted_gain_m3 == plan.volume_m3(*plan.best()->revealed_voxels));
    }
  }
}

TEST_CASE("a recorded frame is a candidate, even where a plan would reject the pose") {
  // The last camera stands in the work area, low behind the post, where the first two do not see.
  PlanInput input = recording({{0.9, 0.1, 0.1}, {0.9, -0.1, 0.1}, {-0.15, 0, 0.02}});
  const ReplayBenchmarkOptions settings = settings_for({"voxel"});
  const auto pairs = evaluate_replay(input, settings).pairs;
  const auto pair = std::ranges::find(pairs, std::array{0, 10}, &ReplayPair::frames);
  REQUIRE(pair != pairs.end());
  const ReplayView& view = pair->views.at(0);

  PlanRequest request = input.request;
  request.volume.filter = FalseShadowFilter::off;
  request.candidates = ViewList{{input.world.cameras[2].camera.T_world_cam()}};
  const Plan plan = plan_next_view(world_of(input, {0, 10}), request);
  CHECK(plan.candidates.at(0).rejected == InvalidReason::inside_shadow);
  CHECK(view.frame == 20);
  CHECK(view.predicted_gain_m3 > 0);
}

TEST_CASE("what a frame did not measure, it does not reveal") {
  PlanInput input = all_around();
  for (std::size_t i = 2; i < 6; ++i) {
    input.world.cameras[i].depth = std::make_shared<const DepthImage>(kSmall.width, kSmall.height);
  }
  const auto evaluation = evaluate_replay(input, settings_for({"voxel"}));
  REQUIRE(evaluation.pairs.size() == 1);  // of those that see anything
  CHECK(evaluation.pairs[0].frames == std::array{0, 10});
  double predicted_m3 = 0;
  for (const ReplayView& view : evaluation.pairs[0].views) {
    predicted_m3 += view.predicted_gain_m3;
    CHECK(view.real_gain_m3 == 0);
  }
  CHECK(predicted_m3 > 0);
  CHECK_FALSE(replay_means(evaluation, 0));
}

TEST_CASE("frames need not be of one camera") {
  const PlanInput wide = all_around();
  PlanInput input = wide;
  DepthCamera& narrow = input.world.cameras[3];
  const PinholeCamera tele({40, 30, 400, 400, 19.5, 14.5}, narrow.camera.T_world_cam(), {0.02, 3});
  narrow.camera = tele;
  narrow.depth = std::make_shared<const DepthImage>(post_and_block()->render_depth(tele));
  ReplayBenchmarkOptions settings = settings_for({"voxel"});
  settings.pairs = 100;
  double wide_m3 = 0, tele_m3 = 0;
  const auto pairs = evaluate_replay(input, settings).pairs;
  CHECK(pairs.size() == 10);  // the tele lens alone shows too little
  for (const ReplayPair& pair : pairs) {
    CHECK(std::ranges::count(pair.frames, 30) == 0);
    tele_m3 += std::ranges::find(pair.views, 30, &ReplayView::frame)->predicted_gain_m3;
  }
  for (const ReplayPair& pair : evaluate_replay(wide, settings).pairs) {
    if (std::ranges::count(pair.frames, 30) > 0) continue;
    wide_m3 += std::ranges::find(pair.views, 30, &ReplayView::frame)->predicted_gain_m3;
  }
  CHECK(tele_m3 > 0);
  CHECK(tele_m3 < 0.5 * wide_m3);
}

TEST_CASE("a replay is the same at any number of threads") {
  const PlanInput input = all_around();
  const ReplayBenchmarkOptions settings = settings_for({"voxel", "shadow"});
  const auto run = [&](int threads) {
    return tbb::task_arena(threads).execute([&] { return evaluate_replay(input, settings); });
  };
  const auto one = run(1), four = run(4);
  REQUIRE(one.pairs.size() == four.pairs.size());
  for (std::size_t p = 0; p < one.pairs.size(); ++p) {
    CHECK(one.pairs[p].frames == four.pairs[p].frames);
    CHECK(one.pairs[p].picks == four.pairs[p].picks);
    for (std::size_t i = 0; i < one.pairs[p].views.size(); ++i) {
      CHECK(one.pairs[p].views[i].scores == four.pairs[p].views[i].scores);
      CHECK(one.pairs[p].views[i].real_gain_m3 == four.pairs[p].views[i].real_gain_m3);
    }
  }
}

TEST_CASE("recordings that cannot be replayed are refused") {
  const ReplayBenchmarkOptions settings = settings_for({"voxel"});
  PlanInput input = all_around();
  input.world.cameras[4].depth = nullptr;
  expect_replay_refused(input, settings, "image 40", "it has no depth image");

  input = all_around();
  input.world.cameras.erase(input.world.cameras.begin() + 2, input.world.cameras.end());
  expect_replay_refused(input, settings, "dataset", "found 2 frames");

  input = all_around();
  input.request.work_area = Box({5, 5, 0}, {5.6, 5.6, 0.3});
  expect_replay_refused(input, settings, "work area", "of 6 frames, 0 show at least 10 % of it");

  input = all_around();
  ReplayBenchmarkOptions strict = settings;
  strict.min_seen = 1;
  expect_replay_refused(input, strict, "work area", "lower --least-seen");
}

TEST_CASE("a cancelled replay comes back") {
  const StopToken stop;
  stop.cancel();
  const auto evaluation = evaluate_replay(all_around(), settings_for({"voxel"}), stop);
  CHECK(evaluation.pairs.empty());
}

TEST_CASE("several methods, each once") {
  CHECK(named_methods({"voxel", "shadow"}).at(1).name == "shadowD6");
  CHECK_THROWS_WITH_AS(named_methods({"shadow", "shadowD6"}),
                       "--methods: found shadowD6 twice; name it once", Error);
}

}  // namespace vantage::test
