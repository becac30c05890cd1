#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <limits>

#include "reconstruction/voting_scenes.hpp"
#include "support/expect_error.hpp"

namespace vantage::test {

TEST_CASE("voting: what cannot be used has its reason, and nothing is invented") {
  const ObjectType cube = marked_box("cube", kCubeSize, 0);
  const MemoryKnowledgeBase knowledge({cube});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto views = aimed({{0.5, 0.2, 0.3}, {0.4, -0.3, 0.3}});
  CHECK(reconstruct_voting({}, knowledge).objects.empty());
  CHECK(reconstruct_voting(views, MemoryKnowledgeBase()).objects.empty());
  CHECK(reconstruct_voting(views, knowledge).objects.empty());  // no markers

  const SeenPoints good = pixels_of(views[0], cube.features[0], Pose());
  SeenPoints broken = good, flat = good, gone = good;
  broken.pixels[2].x() = nan;
  for (int i = 0; i < 4; ++i) flat.pixels[std::size_t(i)] = {100.0 + 20 * i, 100};
  for (Eigen::Vector2d& pixel : gone.pixels) pixel = {50, 50};
  const FeatureKey key = cube.features[0].key;
  views[0].observations = {{key, broken},
                           {key, flat},
                           {key, gone},
                           {{"aruco", "4X4/77"}, good},
                           {key, SeenPoints{{{1, 2}}, 0.1}},
                           {key, SeenPose{Pose(), 0.0, 0.1}},
                           {{"color", "red"}, SeenLabel{{0, 0, 1}}}};
  views[1].T_world_cam.reset();
  views[1].observations = {{key, good}};
  const Reconstruction nothing = reconstruct_voting(views, knowledge);
  CHECK(nothing.objects.empty());
  check_accounts(views, nothing);

  views[0].observations = {{key, good}, {key, good}};  // twice the same
  const Reconstruction once = reconstruct_voting(views, knowledge);
  REQUIRE(once.objects.size() == 1);
  CHECK(once.objects[0].support.size() == 1);
  check_accounts(views, once);

  // Far beyond what a table can hold.
  ObjectType far = cube;
  far.features = {{{"pose", "cube"}, FeaturePose{}}};
  views[0].observations = {
      {{"pose", "cube"}, SeenPose{Pose::from_translation({0, 0, 1e9}), 0.001, 0.01}}};
  const Reconstruction lost = reconstruct_voting(views, MemoryKnowledgeBase({far}));
  CHECK(lost.objects.empty());
  check_accounts(views, lost);
}

TEST_CASE("voting: invalid bounds are refused") {
  const MemoryKnowledgeBase knowledge;
  expect_bad_input("options: merge_m", "found 0",
                   [&] { reconstruct_voting({}, knowledge, {.merge_m = 0}); });
  expect_bad_input("options: inlier_px", "expected a positive",
                   [&] { reconstruct_voting({}, knowledge, {.inlier_px = -1}); });
}

TEST_CASE("voting: stops when cancelled, with what it has") {
  Random random(7);
  const MemoryKnowledgeBase knowledge({marked_box("cube", kCubeSize, 0)});
  auto views = cameras_around(random, 3);
  look_at(views, scattered(random, knowledge.types(), 4, 0.15), {}, random);
  const StopToken stop;
  stop.cancel();
  const Reconstruction result = reconstruct_voting(views, knowledge, {}, stop);
  CHECK(result.stopped == StopReason::cancelled);
  CHECK(result.objects.empty());
  check_accounts(views, result);
}

TEST_CASE("voting: the same to the bit at any number of threads") {
  Random random(8);
  const MemoryKnowledgeBase knowledge({marked_box("cube", kCubeSize, 0),
                                       marked_box("twin", kCubeSize, 0),
                                       marked_box("brick", kCubeSize, 10)});
  auto views = cameras_around(random, 6);
  look_at(views, scattered(random, knowledge.types(), 8, 0.2), {.wrong_id = 0.05}, random);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return reconstruct_voting(views, knowledge);
  };
  const Reconstruction one = with_threads(1), many = with_threads(4);
  REQUIRE(one.objects.size() == many.objects.size());
  for (std::size_t i = 0; i < one.objects.size(); ++i) {
    const ReconstructedObject &a = one.objects[i], &b = many.objects[i];
    CHECK(a.type == b.type);
    CHECK(a.T_world_object.rotation() == b.T_world_object.rotation());
    CHECK(a.T_world_object.translation() == b.T_world_object.translation());
    CHECK(a.probability == b.probability);
    CHECK(a.support.size() == b.support.size());
    CHECK(a.alternatives.size() == b.alternatives.size());
  }
  CHECK(one.unexplained.size() == many.unexplained.size());
}

}  // namespace vantage::test
