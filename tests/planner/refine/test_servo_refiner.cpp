#include <doctest/doctest.h>

#include "vantage/planner/advanced/servo_refiner.hpp"
#include "vantage/volume/advanced/classify.hpp"

namespace vantage {
namespace {

/// Shows a ball of shadow in front of nothing.
class BallView final : public ShadowView {
 public:
  BallView(const Eigen::Vector3d& centre, double radius_m) : centre_(centre), radius_m_(radius_m) {}

  std::optional<ShadowBounds> shadow_bounds(const PinholeCamera& view) const override {
    std::optional<ShadowBounds> bounds;
    const Intrinsics& k = view.intrinsics();
    for (int v = 0; v < k.height; ++v) {
      for (int u = 0; u < k.width; ++u) {
        if (!hits(view.pixel_ray(u, v))) continue;
        if (!bounds) bounds = ShadowBounds{u, u, v, v};
        bounds->left = std::min(bounds->left, u), bounds->right = std::max(bounds->right, u);
        bounds->bottom = v;
      }
    }
    return bounds;
  }

 private:
  bool hits(const PixelRay& ray) const {
    const Eigen::Vector3d d = ray.direction.normalized(), to = centre_ - ray.origin;
    const double along = to.dot(d);
    return along > 0 && (to - along * d).norm() < radius_m_;
  }

  Eigen::Vector3d centre_;
  double radius_m_;
};

const Eigen::Vector3d kCentre(0, 0, 0.1);
const Intrinsics kIntrinsics{640, 480, 615, 615, 319.5, 239.5};

ServoRefiner refiner(double radius_m, const ViewConstraints& constraints = {},
                     const Intrinsics& k = kIntrinsics, int iterations = 5) {
  const Box area({-0.1, -0.1, 0}, {0.1, 0.1, 0.2});
  const PlanningScene empty({}, classify({}, GridGeometry::covering(area, 0.05)),
                            OccluderMode::mesh);
  const DepthRange range{0.05, 5};
  return ServoRefiner(std::make_shared<const BallView>(kCentre, radius_m),
                      std::make_shared<const ViewValidityChecker>(constraints, empty, range),
                      PinholeCamera(k, Pose(), range), kCentre, {iterations, 160});
}

/// Where on the full image the ball's middle is, pixels from the image's middle.
double miss_px(const Pose& pose, const Intrinsics& k = kIntrinsics) {
  const auto p = PinholeCamera(k, pose).project(kCentre);
  return std::hypot(p->u - (k.width - 1) / 2.0, p->v - (k.height - 1) / 2.0);
}

double distance_m(const Pose& pose) {
  return (pose.translation() - kCentre).norm();
}

}  // namespace

TEST_CASE("the servo turns towards the shadow, wherever it is on the image") {
  for (const Eigen::Vector3d& target :
       {Eigen::Vector3d(0.15, 0, 0.1), Eigen::Vector3d(-0.1, 0, 0.2), Eigen::Vector3d(0, 0, 0)}) {
    const auto path = refiner(0.12).path(Pose::looking_at({0.1, -0.7, 0.4}, target));
    REQUIRE(path.size() >= 2);
    CHECK(path.front().move == ServoMove::start);
    CHECK(miss_px(path.front().T_world_cam) > 60);
    CHECK(miss_px(path.back().T_world_cam) < 8);  // a pixel or two of the small image
  }
}

TEST_CASE("the image's middle aims, also where the optical axis is not in it") {
  const Intrinsics k{640, 480, 615, 615, 200, 300};
  const auto path = refiner(0.1, {}, k).path(Pose::looking_at({0.1, -0.7, 0.4}, {0.1, 0, 0.1}));
  CHECK(miss_px(path.front().T_world_cam, k) > 100);
  CHECK(miss_px(path.back().T_world_cam, k) < 12);
}

TEST_CASE("it backs off from shadow that touches opposite borders") {
  const auto path = refiner(0.15).path(Pose::looking_at({0, -0.35, 0.1}, kCentre));
  REQUIRE(path.size() >= 2);
  CHECK(path[1].move == ServoMove::back);
  CHECK(distance_m(path[1].T_world_cam) == doctest::Approx(1.25 * 0.35).epsilon(0.01));
  const auto seen =
      BallView(kCentre, 0.15).shadow_bounds(PinholeCamera(kIntrinsics, path.back().T_world_cam));
  CHECK(seen->top > 2);
  CHECK(seen->bottom < 477);
}

TEST_CASE("it closes in on shadow that is small, until it is not") {
  const auto path = refiner(0.04).path(Pose::looking_at({0, -1.5, 0.4}, kCentre));
  REQUIRE(path.size() == 6);
  for (std::size_t i = 1; i < path.size(); ++i) {
    CHECK(path[i].move != ServoMove::back);
    CHECK(distance_m(path[i].T_world_cam) <= distance_m(path[i - 1].T_world_cam));
  }
  CHECK(path[1].move == ServoMove::closer);
  CHECK(distance_m(path.back().T_world_cam) < 0.3);
  const PinholeCamera last(kIntrinsics, path.back().T_world_cam);
  const auto seen = BallView(kCentre, 0.04).shadow_bounds(last);
  CHECK(seen->left > 10);
  CHECK(seen->right < 629);
}

TEST_CASE("constraints hold at every iteration") {
  ViewConstraints shell;
  shell.reach = Reach{kCentre, 0.6, 0.8};
  const PlanningScene empty(
      {}, classify({}, GridGeometry::covering(Box({-0.1, -0.1, 0}, {0.1, 0.1, 0.2}), 0.05)),
      OccluderMode::mesh);
  const ViewValidityChecker validity(shell, empty, {0.05, 5});
  bool kept = false;
  for (const double radius_m : {0.02, 0.1, 0.6}) {
    for (const Eigen::Vector3d& eye : {Eigen::Vector3d(0, -0.65, 0.3), {0.3, 0.5, 0.5}}) {
      for (const ServoStep& step :
           refiner(radius_m, shell).path(Pose::looking_at(eye, {0.1, 0, 0.1}))) {
        CHECK(validity.check(step.T_world_cam) == InvalidReason::none);
        kept |= step.move == ServoMove::closer || step.move == ServoMove::back;
      }
    }
  }
  CHECK(kept);  // it moved as far as it may
}

TEST_CASE("without shadow on the image the servo stays where it is") {
  CHECK(refiner(0.05).path(Pose::looking_at({0, -0.7, 0.4}, {0, -2, 0.4})).size() == 1);
  CHECK(refiner(0.05, {}, kIntrinsics, 0).path(Pose::looking_at({0, -0.7, 0.4}, kCentre)).size() ==
        1);
}

}  // namespace vantage
