#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reference/plain_picture.hpp"
#include "render/sample_patterns.hpp"
#include "render/srgb_table.hpp"
#include "render/surface_look.hpp"

namespace vantage::raycore::detail {

TEST_CASE("the table of codes is the sRGB curve, to rounding") {
  const SrgbTable table;
  CHECK(table(-1) == 0);
  CHECK(table(std::nanf("")) == 0);
  CHECK(table(1) == 255);
  CHECK(table(7) == 255);
  for (int i = 0; i <= 100000; ++i) {
    const double light = i * 1e-5;
    const double srgb =
        light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
    const double error = table(float(light)) - 255 * srgb;
    CHECK(std::abs(error) < 0.501);
  }
}

TEST_CASE("positions of samples are one to each row and column, and around the pixel's centre") {
  CHECK(SamplePatterns(1, {}).position(0) == Eigen::Vector2f(0, 0));
  for (const int count : {4, 16, 64}) {
    const SamplePatterns patterns(count, {});
    std::set<int> columns, rows;
    Eigen::Vector2f sum = Eigen::Vector2f::Zero();
    for (const Eigen::Vector2f& p : patterns.positions()) {
      columns.insert(int((p.x() + 0.5f) * float(count)));
      rows.insert(int((p.y() + 0.5f) * float(count)));
      sum += p;
    }
    CHECK(int(columns.size()) == count);
    CHECK(int(rows.size()) == count);
    CHECK(sum.norm() < 1e-4f);
  }
}

TEST_CASE("light directions cover sky and sun evenly: those of a pixel, and of 4 x 4 pixels") {
  const PictureOptions options;
  const SamplePatterns patterns(4, options);
  const Eigen::Vector3f sun = options.to_sun.normalized();
  std::set<std::pair<int, int>> parts;  // 8 x 8 of the hemisphere, of equal light
  for (int pixel = 0; pixel < 16; ++pixel) {
    std::set<int> quarters;
    for (int sample = 0; sample < 4; ++sample) {
      const LightDirections& light = patterns.light(40 + pixel % 4, 80 + pixel / 4, sample);
      CHECK(light.to_sky.norm() == doctest::Approx(1).epsilon(1e-3));
      CHECK(light.to_sky.z() > 0);
      CHECK(std::acos(std::min(1.0f, light.to_sun.dot(sun))) <= options.sun_radius * 1.001f);
      const double turn = std::atan2(light.to_sky.y(), light.to_sky.x()) / 6.283185307 + 1;
      const double outward = light.to_sky.head<2>().squaredNorm();
      quarters.insert(int((turn - std::floor(turn)) * 4));
      parts.insert({int((turn - std::floor(turn)) * 8), int(outward * 8)});
    }
    CHECK(quarters.size() == 4);
  }
  CHECK(parts.size() == 64);
}

TEST_CASE("the share of lines in a part of a face is that of many points of it") {
  Material material;
  material.line_spacing_m = 0.1f;
  material.line_width_m = 0.02f;
  material.line_origin = {0.03f, 0, 0};
  const SurfaceLook look(material);
  const Eigen::Vector3f up(0, 0, 1);
  const SamplePatterns fine(64, {});
  test::Random random(3);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3f middle = random.in_cube(1).cast<float>();
    const Eigen::Vector3f per_x = random.in_cube(0.05).cast<float>();
    const Eigen::Vector3f per_y = random.in_cube(0.05).cast<float>();
    int found = 0;
    for (const Eigen::Vector2f& p : fine.positions()) {
      found += look.on_line(middle + p.x() * per_x + p.y() * per_y, up);
    }
    CHECK(look.line_share(middle, per_x, per_y, up, fine.positions()) ==
          doctest::Approx(found / 64.0).epsilon(0.001));
  }
  CHECK(look.line_share({0.03f, 0.05f, 0}, Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero(), up,
                        fine.positions()) == 1);
  CHECK(look.color(1) == material.line_shade * look.color(0));
}

}  // namespace vantage::raycore::detail
