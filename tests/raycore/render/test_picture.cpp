#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

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

TEST_CASE("a picture that is stopped is none, and nonsense is refused") {
  const FloorAndBox world;
  const StopToken stop;
  stop.cancel();
  CHECK_FALSE(render_picture(*world.scene, world.materials, kFromAbove, {}, stop));
  test::expect_bad_input("picture", "1 materials for 2 objects", [&] {
    render_picture(*world.scene, std::vector<Material>(1), kFromAbove);
  });
  PictureOptions options;
  options.samples_per_pixel = 0;
  test::expect_bad_input("picture", "0 samples", [&] {
    render_picture(*world.scene, world.materials, kFromAbove, options);
  });
}

}  // namespace vantage
