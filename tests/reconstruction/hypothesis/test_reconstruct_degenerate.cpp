#include <doctest/doctest.h>

#include "reconstruction/synthetic_views.hpp"
#include "support/expect_error.hpp"
#include "support/non_finite.hpp"
#include "support/scene_count.hpp"
#include "vantage/reconstruction/reconstruct.hpp"

// What no method may crash on or make an object of.

using namespace vantage;
using namespace vantage::test;

namespace {

using Method = Reconstruction (*)(std::span<const CameraView>, const KnowledgeBase&,
                                  const ReconstructOptions&, const StopToken&);
constexpr Method kMethods[] = {reconstruct_svd, reconstruct_pnp};

struct Cell {
  MemoryKnowledgeBase knowledge{{marked_box("box", {0.06, 0.05, 0.07}, 0)}};
  std::vector<CameraView> views;

  explicit Cell(int cameras = 3) {
    Random random(21);
    views = cameras_around(random, cameras);
    look_at(views, {{knowledge.types()[0], Pose::from_translation({0, 0, 0.035})}},
            {.sigma_px = 0.1}, random);
  }

  std::size_t observations() const {
    std::size_t sum = 0;
    for (const CameraView& view : views) sum += view.observations.size();
    return sum;
  }

  Reconstruction by(Method method, const ReconstructOptions& options = {}) const {
    const Reconstruction result = method(views, knowledge, options, {});
    std::size_t listed = result.unexplained.size();
    for (const ReconstructedObject& object : result.objects) {
      listed += object.support.size();
      CHECK(object.T_world_object.translation().norm() < 1);
      CHECK(object.probability > 0);
      CHECK(object.probability <= 1);
    }
    CHECK(listed == observations());
    for (const Unexplained& rest : result.unexplained) CHECK_FALSE(rest.reason.empty());
    return result;
  }

  /// Nothing found, and every observation for this reason.
  void expect_nothing(const std::string& reason) const {
    for (const Method method : kMethods) {
      const Reconstruction result = by(method);
      CHECK(result.objects.empty());
      CHECK(result.unexplained.size() == observations());
      for (const Unexplained& rest : result.unexplained) {
        CAPTURE(rest.reason);
        CHECK(rest.reason.find(reason) != std::string::npos);
      }
    }
  }
};

std::vector<Eigen::Vector2d>& pixels_of(Observation& observation) {
  return std::get<SeenPoints>(observation.data).pixels;
}

}  // namespace

TEST_CASE("degenerate: no views, no observations, no types") {
  const Cell cell;
  for (const Method method : kMethods) {
    CHECK(method({}, cell.knowledge, {}, {}).objects.empty());
    auto blind = cell.views;
    for (CameraView& view : blind) view.observations.clear();
    const Reconstruction nothing = method(blind, cell.knowledge, {}, {});
    CHECK(nothing.objects.empty());
    CHECK(nothing.unexplained.empty());
    const Reconstruction untaught = method(cell.views, MemoryKnowledgeBase(), {}, {});
    CHECK(untaught.objects.empty());
    CHECK(untaught.unexplained.size() == cell.observations());
  }
}

TEST_CASE("degenerate: cameras that are not located") {
  Cell cell;
  for (CameraView& view : cell.views) view.T_world_cam.reset();
  cell.expect_nothing("not located");
}

TEST_CASE("degenerate: corners that are not finite, all the same, or in the wrong order") {
  Cell cell;
  SUBCASE("NaN") {
    for (CameraView& view : cell.views) {
      for (Observation& o : view.observations) pixels_of(o)[2].x() = kNaN;
    }
    cell.expect_nothing("finite");
  }
  SUBCASE("the same") {
    for (CameraView& view : cell.views) {
      for (Observation& o : view.observations) pixels_of(o).assign(4, {100, 100});
    }
    cell.expect_nothing("");
  }
  SUBCASE("crossed") {
    for (CameraView& view : cell.views) {
      for (Observation& o : view.observations) std::swap(pixels_of(o)[0], pixels_of(o)[1]);
    }
    cell.expect_nothing("");
  }
}

TEST_CASE("degenerate: a marker that no type has, or with too many points") {
  Cell cell;
  SUBCASE("unknown") {
    for (CameraView& view : cell.views) {
      for (Observation& o : view.observations) o.key = marker_key("4X4_250", 99);
    }
    cell.expect_nothing("not on any type");
  }
  SUBCASE("points") {
    for (CameraView& view : cell.views) {
      for (Observation& o : view.observations) {
        o.data = SeenPoints{{{10, 10}, {20, 10}, {25, 15}, {20, 20}, {10, 20}}};
      }
    }
    cell.expect_nothing("");
  }
}

TEST_CASE("degenerate: one marker alone is an object") {
  Cell cell(1);
  REQUIRE(cell.views[0].observations.size() >= 1);
  cell.views[0].observations.resize(1);
  for (const Method method : kMethods) CHECK(cell.by(method).objects.size() == 1);
}

TEST_CASE("degenerate: mirrored corners fit no pose and make no object") {
  Cell cell;
  for (CameraView& view : cell.views) {
    for (Observation& o : view.observations) std::swap(pixels_of(o)[1], pixels_of(o)[3]);
  }
  const Reconstruction result = cell.by(reconstruct_pnp);
  CHECK(result.objects.empty());
}

TEST_CASE("degenerate: a duplicate observation counts once") {
  Cell cell;
  const Reconstruction once = cell.by(reconstruct_pnp);
  REQUIRE(once.objects.size() == 1);
  CHECK(once.unexplained.empty());
  const std::size_t before = cell.views[1].observations.size();
  REQUIRE(before >= 1);
  cell.views[1].observations.push_back(cell.views[1].observations[0]);
  for (const Method method : kMethods) {
    const Reconstruction twice = cell.by(method);
    CHECK(twice.objects.size() == 1);
    REQUIRE(twice.unexplained.size() == 1);
    CHECK(twice.unexplained[0].id == ObservationId{1, before});
    CHECK(twice.unexplained[0].reason == "repeats observation 0");
  }
}

TEST_CASE("degenerate: one id at two places of an image is never one object's") {
  Cell cell;
  const Reconstruction once = cell.by(reconstruct_pnp);
  Observation copy = cell.views[0].observations.at(0);
  for (Eigen::Vector2d& pixel : pixels_of(copy)) pixel += Eigen::Vector2d(60, -40);
  cell.views[0].observations.push_back(copy);
  const Reconstruction result = cell.by(reconstruct_pnp);
  REQUIRE_FALSE(result.objects.empty());
  for (const ReconstructedObject& object : result.objects) {
    for (std::size_t i = 0; i < object.support.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const bool same_view = object.support[i].id.view == object.support[j].id.view;
        CHECK_FALSE((same_view && object.support[i].feature == object.support[j].feature));
      }
    }
  }
  // The true one is still the object's.
  const auto& support = result.objects[0].support;
  CHECK(std::any_of(support.begin(), support.end(), [](const Support& s) {
    return s.id == ObservationId{0, 0};
  }));
  CHECK(pose_error(*cell.knowledge.types()[0], result.objects[0].T_world_object,
                   once.objects[0].T_world_object)
            .m < 1e-9);
}

TEST_CASE("degenerate: too few or collinear points determine nothing") {
  ObjectType rod = marked_box("rod", {0.2, 0.02, 0.02}, 0, 0);
  for (int i = 0; i < 5; ++i) {
    rod.features.push_back(
        {{"keypoint", std::to_string(i)}, FeaturePoints{{{0.04 * i - 0.08, 0, 0.01}}}});
  }
  Cell cell;
  cell.knowledge = MemoryKnowledgeBase({rod});
  for (CameraView& view : cell.views) {
    view.observations.clear();
    for (int i = 0; i < 5; ++i) {
      const auto points = rod.features[std::size_t(i)].points();
      view.observations.push_back(
          {rod.features[std::size_t(i)].key,
           SeenPoints{{view.lens.project(view.T_world_cam->inverse() * points[0])}}});
    }
  }
  for (const Method method : kMethods) CHECK(cell.by(method).objects.empty());
}

TEST_CASE("degenerate: random input never crashes, and rarely makes an object") {
  std::size_t objects = 0, observations = 0;
  for (std::uint32_t seed = 1; seed <= scene_count(60); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    Cell cell(4);
    for (CameraView& view : cell.views) {
      view.observations.clear();
      for (int i = 0; i < 6; ++i) {
        SeenPoints seen;
        for (int k = 0; k < 4; ++k) {
          seen.pixels.emplace_back(random.uniform(-50, 700), random.uniform(-50, 500));
        }
        view.observations.push_back({marker_key("4X4_250", int(random.below(8))), seen});
      }
    }
    observations += cell.observations();
    objects += cell.by(reconstruct_pnp).objects.size();
  }
  CAPTURE(observations);
  CHECK(objects <= observations / 20);
}

TEST_CASE("degenerate: options and covariances out of range are errors") {
  Cell cell;
  ReconstructOptions options;
  const auto refuse = [&](const std::string& where, const std::string& message) {
    for (const Method method : kMethods) {
      expect_bad_input(where, message, [&] { cell.by(method, options); });
    }
  };
  SUBCASE("inlier_px") {
    options.inlier_px = 0;
    refuse("options: inlier_px", "found 0; expected a positive");
  }
  SUBCASE("merge_m") {
    options.merge_m = -1;
    refuse("options: merge_m", "found -1");
  }
  SUBCASE("min_evidence") {
    options.min_evidence = kNaN;
    refuse("options: min_evidence", "found nan");
  }
  SUBCASE("covariance") {
    cell.views[1].covariance(2, 2) = kNaN;
    refuse("views: camera 1", "not finite");
  }
}
