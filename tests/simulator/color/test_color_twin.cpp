// The simulator's picture against the slow, obvious twin's.

#include <doctest/doctest.h>

#include "reference/plain_color.hpp"
#include "simulator/color_scenes.hpp"
#include "support/scene_count.hpp"

namespace vantage::test {
namespace {

/// About a metre wide, on a floor: turned boxes, some with pictures, a soup, and a ball that is
/// large enough to be an instance.
std::vector<SimulatedBody> random_bodies(Random& random) {
  const auto color = [&] {
    const float r = float(random.uniform(0, 1)), g = float(random.uniform(0, 1));
    return Eigen::Vector3f(r, g, float(random.uniform(0, 1)));
  };
  std::vector<SimulatedBody> bodies;
  bodies.push_back(box_body(Box({-1, -1, -0.75}, {1, 1, -0.7}), color()));
  for (std::uint32_t i = 0, count = 2 + random.below(4); i < count; ++i) {
    const double half = random.uniform(0.05, 0.2);
    bodies.push_back(
        box_body(Box({-half, -0.1, -0.1}, {half, 0.1, 0.1}), color(), random.pose(0.5)));
  }
  for (int i = 0; i < 3; ++i) {
    bodies.push_back(picture_body(0.4, 0.3, random_texture(random, 12, 9), random.pose(0.5)));
  }
  bodies.push_back(body(triangle_soup(random, 12), color()));
  bodies.push_back(body(icosphere(0.2, 3), color(), random.pose(0.5)));
  return bodies;
}

Lighting random_lighting(Random& random) {
  Lighting lighting;
  lighting.lamp_centre_m = (2.2 * random.direction()).cast<float>();
  lighting.lamp_target_m = random.in_cube(0.2).cast<float>();
  lighting.lamp_share = float(random.uniform(0.2, 0.8));
  return lighting;
}

PinholeCamera random_camera(Random& random) {
  return {{29, 21, 25, 26, 13.5, 10.5}, Pose::looking_at(1.4 * random.direction(), {0, 0, 0})};
}

/// The greatest difference over the channels, in codes.
double difference(const std::uint8_t* code, const Eigen::Vector3d& light) {
  double worst = 0;
  for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(code[c] - code_of(light[c])));
  return worst;
}

}  // namespace

TEST_CASE("with one sample per pixel the picture is the twin's, to rounding") {
  int compared = 0, close_calls = 0;
  for (std::uint32_t seed = 0; seed < scene_count(5); ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const std::vector<SimulatedBody> bodies = random_bodies(random);
    const Lighting lighting = random_lighting(random);
    const PinholeCamera camera = random_camera(random);
    ColorSensor sensor;
    sensor.samples_per_pixel = 1;
    const auto image = simulate_color(SimulatedScene(bodies), lighting, camera, sensor, seed);
    const PlainColor twin(bodies, lighting, camera);
    for (int v = 0; v < image->height; ++v) {
      for (int u = 0; u < image->width; ++u) {
        const PlainLight expected = twin.single_sample(u, v, seed);
        (expected.close_call ? close_calls : compared) += 1;
        if (expected.close_call) continue;
        CAPTURE(u);
        CAPTURE(v);
        CHECK(difference(image->pixel(u, v), expected.light) <= 1);
      }
    }
  }
  CHECK(close_calls < compared / 20);
}

TEST_CASE("with many samples the picture is what other samples of the twin come to" *
          doctest::skip(kSanitized)) {
  Random random(77);
  const std::vector<SimulatedBody> bodies = random_bodies(random);
  const Lighting lighting = random_lighting(random);
  const PinholeCamera camera = random_camera(random);
  ColorSensor sensor;
  sensor.samples_per_pixel = 1000;  // ends in the middle of blocks of rays
  const auto image = simulate_color(SimulatedScene(bodies), lighting, camera, sensor, 5);
  const PlainColor twin(bodies, lighting, camera);
  constexpr int kPixels = 12, kCount = 300;
  double sum = 0;
  for (int i = 0; i < kPixels; ++i) {
    const int u = int(random.below(29)), v = int(random.below(21));
    CAPTURE(u);
    CAPTURE(v);
    const Eigen::Vector3d expected = twin.mean(u, v, kCount, random).light;
    // A sample's light is between 0 and the surface's colour: its deviation is half of that at
    // most.
    const std::uint8_t* code = image->pixel(u, v);
    for (int c = 0; c < 3; ++c) {
      const double error = light_of(code[c]) - expected[c];
      sum += error;
      CHECK(std::abs(error) < 4 * 0.5 * lighting.exposure / std::sqrt(kCount));
    }
  }
  CHECK(std::abs(sum / (3 * kPixels)) < 0.015);  // nor are all of them too bright or too dark
}

}  // namespace vantage::test
