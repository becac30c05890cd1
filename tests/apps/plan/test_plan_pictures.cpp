#include <doctest/doctest.h>

#include <cmath>

#include "plan/demo_command.hpp"
#include "plan/report/plan_pictures.hpp"
#include "plan/report/plan_shapes.hpp"

namespace vantage {
namespace {

constexpr int kTestWidth = 640;

Plan plan_of(const WorldModel& world, int views) {
  PlanRequest request = demo_request();
  request.voxel_size_m = 0.025;
  request.views.most = views;
  return plan_next_view(world, request);
}

struct DemoPlan {
  WorldModel world = demo_world();
  Plan plan;

  explicit DemoPlan(int views) : plan(plan_of(world, views)) {}

  ColorImage draw(std::size_t picture, PictureQuality quality = PictureQuality::draft) const {
    return *PlanPictures(plan, world, kTestWidth, quality).draw(picture, {});
  }
};

KnownObject structure(const std::string& name, const Box& box) {
  return {name, std::make_shared<const TriangleMesh>(TriangleMesh::from_box(box)), Pose()};
}

int difference(const ColorImage& a, const ColorImage& b, int u, int v) {
  int sum = 0;
  for (int c = 0; c < 3; ++c) sum += std::abs(a.pixel(u, v)[c] - b.pixel(u, v)[c]);
  return sum;
}

/// The part of the picture's pixels that differ clearly.
double changed_share(const ColorImage& a, const ColorImage& b) {
  int count = 0;
  for (int v = 0; v < a.height; ++v) {
    for (int u = 0; u < a.width; ++u) count += difference(a, b, u, v) > 12;
  }
  return double(count) / (a.width * a.height);
}

std::pair<int, int> pixel_of(const PinholeCamera& camera, const Eigen::Vector3d& p) {
  const auto q = camera.project(p);
  REQUIRE(q);
  return {int(std::lround(q->u)), int(std::lround(q->v))};
}

}  // namespace

TEST_CASE("each of several views has its picture, and one view has one") {
  const DemoPlan one(1), two(2);
  REQUIRE(two.plan.views.size() == 2);
  const PlanPictures single(one.plan, one.world, kTestWidth, PictureQuality::draft);
  REQUIRE(single.count() == 2);
  CHECK(single.name(0) == "overview.png");
  CHECK(single.name(1) == "view.png");
  const PlanPictures pictures(two.plan, two.world, kTestWidth, PictureQuality::draft);
  REQUIRE(pictures.count() == 3);
  CHECK(pictures.name(2) == "view_2.png");
  const StopToken stop;
  stop.expect(pictures.steps(2));
  const auto second = pictures.draw(2, stop);
  CHECK(stop.progress() == doctest::Approx(1));
  CHECK(second->width == demo_request().intrinsics.width);
  CHECK(changed_share(*second, *pictures.draw(1, {})) > 0.1);
  stop.cancel();
  CHECK_FALSE(pictures.draw(2, stop));
}

TEST_CASE("the overview has a legend in a corner, and numbers on several suggested cameras") {
  const DemoPlan two(2);
  const PinholeCamera camera = overview_camera(two.plan, two.world, kTestWidth);
  const ColorImage plain = *overview(two.plan, two.world, kTestWidth),
                   drawn = two.draw(0, PictureQuality::final);
  CHECK(drawn.width == kTestWidth);
  CHECK(drawn.height == kTestWidth * 5 / 8);
  const double changed = changed_share(plain, drawn);
  CHECK(changed > 0.005);
  CHECK(changed < 0.12);
  for (const Eigen::Vector3d& body : suggested_bodies(two.plan)) {
    const auto [u, v] = pixel_of(camera, body);
    int white = 0, dark = 0;
    for (int dv = -7; dv <= 7; ++dv) {
      for (int du = -7; du <= 7; ++du) {
        const std::uint8_t* p = drawn.pixel(u + du, v + dv);
        white += p[0] > 235 && p[1] > 235 && p[2] > 235;
        dark += p[0] < 110 && p[1] < 110 && p[2] < 110;
      }
    }
    CHECK(white > 30);
    CHECK(dark > 3);
  }
  // Too small for words: nothing is written.
  const PlanPictures small(two.plan, two.world, 320, PictureQuality::final);
  CHECK(*small.draw(0, {}) == *overview(two.plan, two.world, 320));
}

TEST_CASE("structures outside the work area are drawn, but hide nothing") {
  DemoPlan demo(1);
  const ColorImage without = demo.draw(0);
  const PinholeCamera camera = overview_camera(demo.plan, demo.world, kTestWidth);
  // A column that stands before the scene.
  const Eigen::Vector3d centre = demo.plan.request.work_area.centre();
  const Eigen::Vector3d way = (camera.centre() - centre).normalized();
  Eigen::Vector3d foot = centre + 0.5 * way;
  foot.z() = 0;
  const Eigen::Vector3d half(0.06, 0.06, 0);
  demo.world.static_structures.push_back(
      structure("column", Box(foot - half, foot + half + Eigen::Vector3d(0, 0, 1))));
  REQUIRE(structure_meshes(demo.plan, demo.world).size() == 1);
  CHECK(structure_meshes(demo.plan, demo.world).front().opacity < 0.5f);
  const ColorImage with = demo.draw(0);
  const auto [u, v] = pixel_of(camera, foot + Eigen::Vector3d(0, 0, 0.3));
  CHECK(difference(with, without, u, v) > 15);
  CHECK(difference(with, without, u, v) < 250);

  // What is within the area is voxels; a room's walls would hide everything.
  demo.world.static_structures = {structure("inside", Box({-0.05, 0, 0.01}, {0.05, 0.1, 0.1})),
                                  structure("room", Box({-9, -9, -1}, {9, 9, 4}))};
  CHECK(structure_meshes(demo.plan, demo.world).empty());
}

}  // namespace vantage
