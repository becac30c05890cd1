#include <doctest/doctest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <limits>

#include "simulator/color_scenes.hpp"
#include "support/expect_error.hpp"

namespace vantage::test {
namespace {

/// Looks straight down from 2 m: one pixel is 2 cm of the floor, the image's centre the origin, and
/// up in the image is +y.
const PinholeCamera kFromAbove({81, 61, 100, 100, 40, 30}, Pose::looking_at({0, 0, 2}, {0, 0, 0}));

SimulatedScene cubes_on_a_board() {
  Random random(3);
  std::vector<SimulatedBody> bodies = {
      box_body(Box({-0.5, -0.4, -0.05}, {0.5, 0.4, 0}), {0.9f, 0.9f, 0.9f})};
  for (int i = 0; i < 5; ++i) {
    bodies.push_back(box_body(Box({-0.1, -0.1, 0}, {0.1, 0.1, 0.2}), {0.8f, 0.2f, 0.2f},
                              Pose::from_translation({0.25 * i - 0.5, 0.1, 0})));
  }
  bodies.push_back(picture_body(0.3, 0.2, random_texture(random, 30, 20),
                                Pose::from_translation({0, -0.2, 0.01})));
  return SimulatedScene(std::move(bodies));
}

ColorSensor everything_on() {
  ColorSensor sensor;
  sensor.distortion = {-0.1, 0.02, 0.001, -0.0005, 0.001};
  sensor.vignetting = 0.5;
  sensor.read_noise = 0.01;
  sensor.shot_noise = 1e-4;
  return sensor;
}

}  // namespace

TEST_CASE("a photograph is the same to the byte at 1, 2, 3 and 8 threads") {
  const tbb::global_control allow(tbb::global_control::max_allowed_parallelism, 8);
  const SimulatedScene scene = cubes_on_a_board();
  const auto photograph = [&](int threads, std::uint64_t seed) {
    tbb::task_arena arena(threads);
    return *arena.execute(
        [&] { return simulate_color(scene, {}, kFromAbove, everything_on(), seed); });
  };
  const ColorImage first = photograph(1, 7);
  for (const int threads : {2, 3, 8}) CHECK(photograph(threads, 7) == first);
  CHECK(photograph(2, 8) != first);
}

TEST_CASE("what rays miss is background, and bodies have their colours on both sides") {
  Lighting lighting = even_light();
  lighting.background = {0.2f, 0.4f, 0.6f};
  const auto up = picture_body(0.4, 0.4, ColorImage(1, 1, 100));
  const auto turned = picture_body(
      0.4, 0.4, ColorImage(1, 1, 200),
      Pose::from_rotation(Eigen::Vector3d(1, -1, -1).asDiagonal().toDenseMatrix(), {0.5, 0, 0}));
  const auto image =
      simulate_color(SimulatedScene({up, turned}), lighting, kFromAbove, ColorSensor{}, 1);
  CHECK(int(image->pixel(0, 0)[0]) == 51);
  CHECK(int(image->pixel(0, 0)[1]) == 102);
  CHECK(int(image->pixel(0, 0)[2]) == 153);
  CHECK(int(image->pixel(40, 30)[0]) == 100);
  CHECK(int(image->pixel(65, 30)[0]) == 200);
}

TEST_CASE("texels that are magnified are crisp and have their own colours") {
  Random random(4);
  const ColorImage picture = random_texture(random, 9, 7);
  const auto scene = SimulatedScene({picture_body(1.44, 1.12, picture)});  // a texel is 8 pixels
  const auto image = simulate_color(scene, even_light(), kFromAbove, ColorSensor{}, 1);
  for (int v = 0; v < 61; ++v) {
    for (int u = 0; u < 81; ++u) {
      // Borders of texels go through the centres of every eighth pixel; all others are of one
      // texel.
      if ((u - 4) % 8 == 0 || (v - 2) % 8 == 0) continue;
      if (u < 4 || u > 76 || v < 2 || v > 58) continue;
      CAPTURE(u);
      CAPTURE(v);
      for (int c = 0; c < 3; ++c) {
        CHECK(int(image->pixel(u, v)[c]) == int(picture.pixel((u - 4) / 8, (v - 2) / 8)[c]));
      }
    }
  }
  // On a border it is half and half, in linear light.
  const double left = light_of(picture.pixel(3, 3)[0]), right = light_of(picture.pixel(4, 3)[0]);
  CHECK(image->pixel(4 + 32, 30)[0] == doctest::Approx(code_of((left + right) / 2)).epsilon(0.01));
}

TEST_CASE("vignetting follows the fourth power of the cosine") {
  const auto scene = SimulatedScene({picture_body(4, 4, ColorImage(1, 1, 255))});
  for (const double part : {1.0, 0.5, 0.0}) {
    ColorSensor sensor;
    sensor.vignetting = part;
    const auto image = simulate_color(scene, even_light(), kFromAbove, sensor, 1);
    for (int v = 0; v < 61; ++v) {
      for (int u = 0; u < 81; ++u) {
        const double tangent = std::hypot(u - 40, v - 30) / 100;
        const double cos4 = std::pow(std::cos(std::atan(tangent)), 4);
        const double expected = code_of(1 - (1 - cos4) * part);
        CHECK(std::abs(image->pixel(u, v)[1] - expected) <= 0.51);
      }
    }
  }
}

TEST_CASE("what is stopped gives no photograph") {
  const SimulatedScene scene = cubes_on_a_board();
  const StopToken go, stop;
  CHECK(simulate_color(scene, {}, kFromAbove, {}, 1, go));
  stop.cancel();
  CHECK_FALSE(simulate_color(scene, {}, kFromAbove, {}, 1, stop));
}

TEST_CASE("nonsense is refused by its name") {
  const SimulatedScene scene = cubes_on_a_board();
  const auto refused_sensor = [&](const char* message, const auto& change) {
    ColorSensor sensor;
    change(sensor);
    expect_bad_input("color sensor", message,
                     [&] { simulate_color(scene, {}, kFromAbove, sensor, 1); });
  };
  refused_sensor("samples_per_pixel is 0; expected 1 to 4096",
                 [](ColorSensor& s) { s.samples_per_pixel = 0; });
  refused_sensor("samples_per_pixel is 4097", [](ColorSensor& s) { s.samples_per_pixel = 4097; });
  refused_sensor("vignetting is 1.5", [](ColorSensor& s) { s.vignetting = 1.5; });
  refused_sensor("read_noise is -0.1", [](ColorSensor& s) { s.read_noise = -0.1; });
  refused_sensor("shot_noise is nan", [](ColorSensor& s) { s.shot_noise = std::nan(""); });

  const auto refused_light = [&](const char* message, const auto& change) {
    Lighting lighting;
    change(lighting);
    expect_bad_input("lighting", message,
                     [&] { simulate_color(scene, lighting, kFromAbove, {}, 1); });
  };
  const float inf = std::numeric_limits<float>::infinity();
  refused_light("a coordinate of lamp_centre_m is inf",
                [&](Lighting& l) { l.lamp_centre_m.y() = inf; });
  refused_light("a coordinate of lamp_target_m is -inf",
                [&](Lighting& l) { l.lamp_target_m.y() = -inf; });
  refused_light("the distance from lamp_centre_m to lamp_target_m is 0",
                [](Lighting& l) { l.lamp_target_m = l.lamp_centre_m; });
  refused_light("lamp_side_m is 0", [](Lighting& l) { l.lamp_side_m = 0; });
  refused_light("exposure is -1", [](Lighting& l) { l.exposure = -1; });
  refused_light("lamp_share is 2", [](Lighting& l) { l.lamp_share = 2; });
  refused_light("bounce is -1", [](Lighting& l) { l.bounce = -1; });
  refused_light("sky_reach_m is 0", [](Lighting& l) { l.sky_reach_m = 0; });
  refused_light("a channel of background is 2", [](Lighting& l) { l.background.z() = 2; });
}

TEST_CASE("bodies that cannot be painted are refused by their name") {
  const auto refused = [](const char* message, const auto& change) {
    TexturedMesh shape = *picture_body(1, 1, ColorImage(2, 2)).shape;
    change(shape);
    const SimulatedScene scene({{"tile", std::make_shared<TexturedMesh>(shape), {}}});
    expect_bad_input("body tile", message, [&] { simulate_color(scene, {}, kFromAbove, {}, 1); });
  };
  refused("its colour is [0.75, 1.2, 0.75]", [](TexturedMesh& s) { s.color.y() = 1.2f; });
  refused("its texture of 0 x 0 texels", [](TexturedMesh& s) { s.texture = {}; });
  refused("has 11 samples", [](TexturedMesh& s) { s.texture.samples.pop_back(); });
  refused("a texture coordinate of triangle 1 is (nan,",
          [](TexturedMesh& s) { s.uv[1][2].x() = std::nanf(""); });
}

}  // namespace vantage::test
