#pragma once

#include <Eigen/Core>
#include <cmath>
#include <memory>
#include <vector>

#include "reference/random_scene.hpp"
#include "simulator/color/color_sensor.hpp"
#include "vantage/raycore/box.hpp"

namespace vantage::test {

inline SimulatedBody body(TriangleMesh mesh, const Eigen::Vector3f& color, const Pose& pose = {}) {
  auto shape = std::make_shared<TexturedMesh>();
  shape->mesh = std::move(mesh);
  shape->color = color;
  return {"body", std::move(shape), pose};
}

inline SimulatedBody box_body(const Box& box, const Eigen::Vector3f& color, const Pose& pose = {}) {
  return body(TriangleMesh::from_box(box), color, pose);
}

/// A rectangle on z = 0 around the origin that faces up, with a picture on it: its upper left texel
/// lies at -x, +y.
inline SimulatedBody picture_body(double width_m, double height_m, ColorImage picture,
                                  const Pose& pose = {}) {
  const float x = float(width_m / 2), y = float(height_m / 2);
  const float w = float(picture.width), h = float(picture.height);
  auto shape = std::make_shared<TexturedMesh>();
  shape->mesh =
      TriangleMesh({{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const Eigen::Vector2f corner[] = {{0, h}, {w, h}, {w, 0}, {0, 0}};
  shape->uv = {{corner[0], corner[1], corner[2]}, {corner[0], corner[2], corner[3]}};
  shape->texture = std::move(picture);
  return {"picture", std::move(shape), pose};
}

inline ColorImage random_texture(Random& random, int width, int height) {
  ColorImage image(width, height);
  for (std::uint8_t& sample : image.samples) sample = std::uint8_t(random.below(256));
  return image;
}

/// Light from everywhere and no lamp: a surface with nothing around shows its own colour.
inline Lighting even_light() {
  Lighting lighting;
  lighting.exposure = 1;
  lighting.lamp_share = 0;
  return lighting;
}

/// The sRGB code of linear light, in double.
inline double code_of(double light) {
  const double l = std::min(light, 1.0);
  return 255 * (l <= 0.0031308 ? 12.92 * l : 1.055 * std::pow(l, 1 / 2.4) - 0.055);
}

inline double light_of(double code) {
  const double c = code / 255;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

}  // namespace vantage::test
