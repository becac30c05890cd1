#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdlib>

#include "support/expect_error.hpp"
#include "vantage/raycore/advanced/picture.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"

namespace vantage {
namespace {

/// Looks straight down on a floor of 2 m: one pixel is 2 cm, the image's centre the origin, and up
/// in the image is +y.
const PinholeCamera kFromAbove({81, 61, 100, 100, 40, 30}, Pose::looking_at({0, 0, 2}, {0, 0, 0}));

PictureOptions sun_from_above() {
  PictureOptions options;
  options.samples_per_pixel = 16;
  options.to_sun = {0, 0, 1};
  return options;
}

int brightness(const ColorImage& image, int u, int v) {
  const std::uint8_t* p = image.pixel(u, v);
  return p[0] + p[1] + p[2];
}

struct FloorAndBox {
  std::shared_ptr<const Scene> scene;
  std::vector<Material> materials;

  FloorAndBox() : materials(2) {
    SceneBuilder builder;
    builder.add_box(Box({-1, -1, -0.1}, {1, 1, 0}));
    builder.add_box(Box({-0.2, -0.2, 0.3}, {0.2, 0.2, 0.4}));  // hovers
    scene = builder.build();
    materials[1].color = {0.9f, 0.1f, 0.1f};
  }
};

}  // namespace

TEST_CASE("a picture has each object in its colour, and the background beside them") {
  const FloorAndBox world;
  PictureOptions options = sun_from_above();
  options.background = {0, 0, 1};
  const PinholeCamera from_side({81, 61, 30, 30, 40, 30}, Pose::looking_at({0, -3, 1}, {0, 0, 0}));
  const auto image = render_picture(*world.scene, world.materials, from_side, options);
  REQUIRE(image);
  CHECK(image->pixel(40, 0)[2] == 255);  // sky
  CHECK(image->pixel(40, 0)[0] == 0);
  const auto down = render_picture(*world.scene, world.materials, kFromAbove, options);
  CHECK(down->pixel(40, 30)[0] > 3 * down->pixel(40, 30)[1]);                   // the red box
  CHECK(std::abs(int(down->pixel(5, 5)[0]) - int(down->pixel(5, 5)[1])) <= 1);  // the grey floor
}

TEST_CASE("a box shades the floor beneath, on the side away from the sun") {
  const FloorAndBox world;
  PictureOptions options = sun_from_above();
  options.to_sun = {-1, 0, 1};  // the shadow falls towards +x: 0.3 to 0.4 m beside the box
  options.sun_radius = 0.01f;
  const auto image = render_picture(*world.scene, world.materials, kFromAbove, options);
  const int shaded = brightness(*image, 40 + 20, 30), lit = brightness(*image, 40 - 20, 30);
  CHECK(lit - shaded > 120);
  CHECK(brightness(*image, 40 + 36, 30) == doctest::Approx(lit).epsilon(0.03));
}

TEST_CASE("lines are drawn where they belong, and a fading object ends in the background") {
  SceneBuilder builder;
  builder.add_box(Box({-1, -1, -0.1}, {1, 1, 0}));
  const auto scene = builder.build();
  std::vector<Material> materials(1);
  materials[0].line_spacing_m = 0.2f;
  materials[0].line_width_m = 0.04f;
  materials[0].line_shade = 0.1f;
  materials[0].line_origin = {0.1f, 0.1f, 0};
  const auto lines = render_picture(*scene, materials, kFromAbove, sun_from_above());
  CHECK(brightness(*lines, 45, 30) * 2 < brightness(*lines, 40, 30));  // x = 0.1 m, and the centre
  CHECK(brightness(*lines, 55, 30) * 2 < brightness(*lines, 50, 30));

  materials[0] = {};
  materials[0].fade_from_m = 0.1f;
  materials[0].fade_to_m = 0.5f;
  PictureOptions options = sun_from_above();
  options.background = {1, 0, 0};
  const auto faded = render_picture(*scene, materials, kFromAbove, options);
  CHECK(faded->pixel(0, 30)[1] == 0);
  CHECK(faded->pixel(40, 30)[1] > 100);
}

TEST_CASE("a picture is the same to the byte at 1, 2, 3 and 8 threads") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const FloorAndBox world;
  const auto draw = [&](int threads) {
    tbb::task_arena arena(threads);
    return arena.execute([&] {
      return render_picture(*world.scene, world.materials, kFromAbove, sun_from_above());
    });
  };
  const auto first = draw(1);
  for (const int threads : {2, 3, 8}) CHECK(*draw(threads) == *first);
}

TEST_CASE("a stopped picture returns nothing, and invalid options are refused") {
  const FloorAndBox world;
  const StopToken stop;
  stop.cancel();
  CHECK_FALSE(render_picture(*world.scene, world.materials, kFromAbove, {}, stop));
  test::expect_bad_input("picture", "1 materials for 2 objects", [&] {
    render_picture(*world.scene, std::vector<Material>(1), kFromAbove);
  });
  PictureOptions options;
  options.samples_per_pixel = 0;
  test::expect_bad_input("picture", "samples_per_pixel is 0; expected 1 to 1024", [&] {
    render_picture(*world.scene, world.materials, kFromAbove, options);
  });
  options = {.first_samples = 1025};
  test::expect_bad_input("picture", "first_samples is 1025", [&] {
    render_picture(*world.scene, world.materials, kFromAbove, options);
  });
}

TEST_CASE("drawing advances by its steps") {
  const FloorAndBox world;
  const PinholeCamera camera({200, 100, 100, 100, 100, 50}, kFromAbove.T_world_cam());
  const StopToken stop;
  stop.expect(2 * picture_steps(200, 100));
  CHECK(render_picture(*world.scene, world.materials, camera, sun_from_above(), stop));
  CHECK(stop.progress() == doctest::Approx(0.5));
}

TEST_CASE("tiles leave no seams: a picture is a part of a larger one") {
  const FloorAndBox world;
  const auto draw = [&](int width, int height) {
    const PinholeCamera camera({width, height, 300, 300, 160, 100}, kFromAbove.T_world_cam());
    return *render_picture(*world.scene, world.materials, camera, sun_from_above());
  };
  const ColorImage large = draw(320, 210), small = draw(150, 120);
  int worst = 0;
  for (int v = 0; v < 110; ++v) {  // the small one's border knows fewer neighbours
    for (int u = 0; u < 140; ++u) {
      worst = std::max(worst, std::abs(large.pixel(u, v)[0] - small.pixel(u, v)[0]));
    }
  }
  CHECK(worst <= 2);
}

TEST_CASE("edges of objects and of hard shadows stay sharp") {
  const FloorAndBox world;
  PictureOptions options = sun_from_above();
  options.to_sun = {-1, 0, 1};
  options.sun_radius = 0.001f;
  const PinholeCamera camera({400, 300, 400, 400, 200, 150}, kFromAbove.T_world_cam());
  const auto image = render_picture(*world.scene, world.materials, camera, options);
  // The shadow ends at x = 0.6 m in front of its bottom: brighter within two pixels.
  const auto at = [&](int u) { return brightness(*image, u, 150); };
  CHECK(at(200 + 123) - at(200 + 117) > 100);
  int steps = 0;
  for (int u = 200 + 100; u < 200 + 140; ++u) steps += std::abs(at(u + 1) - at(u)) > 12;
  CHECK(steps <= 2);
}

}  // namespace vantage
