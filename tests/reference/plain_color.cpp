#include "reference/plain_color.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "simulator/color/sample_table.hpp"

namespace vantage::test {
namespace {

double linear(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

/// z is the normal; x and y as in Duff et al., "Building an orthonormal basis, revisited", 2017.
Eigen::Matrix3d frame_around(const Eigen::Vector3d& n) {
  const double sign = n.z() < 0 ? -1 : 1, a = -1 / (sign + n.z());
  Eigen::Matrix3d frame;
  frame.col(0) << 1 + sign * a * n.x() * n.x(), sign * a * n.x() * n.y(), -sign * n.x();
  frame.col(2) = n;
  frame.col(1) = n.cross(frame.col(0));
  return frame;
}

}  // namespace

PlainColor::PlainColor(const std::vector<SimulatedBody>& bodies, const Lighting& lighting,
                       const PinholeCamera& camera)
    : bodies_(bodies), lighting_(lighting), camera_(camera) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    scene_.add(bodies[i].shape->mesh, bodies[i].T_world_body, ObjectId(i));
  }
  centre_ = lighting.lamp_centre_m.cast<double>();
  const Eigen::Vector3d target = lighting.lamp_target_m.cast<double>();
  facing_ = (target - centre_).normalized();
  side_x_ = lighting.lamp_side_m * facing_.cross(Eigen::Vector3d::UnitZ()).normalized();
  side_y_ = side_x_.cross(facing_);
  lamp_scale_ = lighting.exposure * lighting.lamp_share / lamp_light(target, -facing_);
}

Eigen::Vector3d PlainColor::on_lamp(const Eigen::Vector2d& xy) const {
  return centre_ + xy.x() * side_x_ + xy.y() * side_y_;
}

double PlainColor::lamp_light(const Eigen::Vector3d& position,
                              const Eigen::Vector3d& normal) const {
  constexpr int kSide = 20;
  double sum = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const Eigen::Vector2d xy((i % kSide + 0.5) / kSide - 0.5, (i / kSide + 0.5) / kSide - 0.5);
    const Eigen::Vector3d to_lamp = on_lamp(xy) - position;
    const double here = to_lamp.normalized().dot(normal);
    const double there = -to_lamp.normalized().dot(facing_);
    sum += std::max(0.0, here) * std::max(0.0, there) / to_lamp.squaredNorm();
  }
  return lamp_scale_ * sum / (kSide * kSide);
}

PlainLight PlainColor::single_sample(int u, int v, std::uint64_t seed) const {
  const SampleTable table(1, seed);
  const auto width = std::uint64_t(camera_.intrinsics().width);
  const LightSamples s = table.of_pixel(std::uint64_t(v) * width + std::uint64_t(u));
  return look(u, v, {{0, 0}, {*s.lamp_x, *s.lamp_y}, {*s.sky_x, *s.sky_y, *s.sky_z}});
}

PlainLight PlainColor::mean(int u, int v, int count, Random& random) const {
  PlainLight sum;
  for (int i = 0; i < count; ++i) {
    Directions d;
    d.in_pixel = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
    d.on_lamp = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
    const double angle = random.uniform(0, 2 * std::numbers::pi), squared = random.uniform(0, 1);
    d.sky << std::sqrt(squared) * std::cos(angle), std::sqrt(squared) * std::sin(angle),
        std::sqrt(1 - squared);
    sum.light += look(u, v, d).light / count;
  }
  return sum;
}

PlainLight PlainColor::look(double u, double v, const Directions& d) const {
  const PixelRay ray = camera_.pixel_ray(u + d.in_pixel.x(), v + d.in_pixel.y());
  const WorldTriangle* nearest = nullptr;
  double depth = std::numeric_limits<double>::infinity();
  for (const WorldTriangle& triangle : scene_.triangles()) {
    const Crossing c = triangle.cross(ray.origin, ray.direction);
    if (c.margin_m >= 0 && c.t > 0 && c.t < depth) nearest = &triangle, depth = c.t;
  }
  const Verdict verdict = scene_.closest_hit(ray.origin.cast<float>(), ray.direction.cast<float>(),
                                             0, std::numeric_limits<double>::infinity());
  PlainLight result;
  if (nearest == nullptr) {
    for (int c = 0; c < 3; ++c) result.light[c] = linear(lighting_.background[c]);
  } else {
    Point point;
    point.position = ray.origin + depth * ray.direction;
    point.depth = depth;
    const Eigen::Vector3d normal = nearest->cross(ray.origin, ray.direction).normal;
    point.normal = normal.dot(ray.direction) > 0 ? Eigen::Vector3d(-normal) : normal;
    point.color = color_at(*nearest, point.position, result.close_call);
    const PlainLight light = shade(point, d);
    result = {light.light, light.close_call || result.close_call};
  }
  result.close_call |= verdict.close_call;
  return result;
}

Eigen::Vector3d PlainColor::color_at(const WorldTriangle& triangle, const Eigen::Vector3d& position,
                                     bool& close_call) const {
  const TexturedMesh& shape = *bodies_[triangle.object].shape;
  if (!shape.textured()) return shape.color.cast<double>().unaryExpr(&linear);
  Eigen::Matrix3d corners;
  for (int c = 0; c < 3; ++c) corners.col(c) = triangle.corners[c];
  const Eigen::Vector3d weights = corners.colPivHouseholderQr().solve(position);
  Eigen::Vector2d uv = Eigen::Vector2d::Zero();
  for (int c = 0; c < 3; ++c) uv += weights[c] * shape.uv[triangle.index][c].cast<double>();
  int texel[2];
  const int size[] = {shape.texture.width, shape.texture.height};
  for (int axis = 0; axis < 2; ++axis) {
    close_call |= std::abs(uv[axis] - std::round(uv[axis])) < 1e-3;
    texel[axis] = std::clamp(int(std::floor(uv[axis])), 0, size[axis] - 1);
  }
  const std::uint8_t* code = shape.texture.pixel(texel[0], texel[1]);
  return {linear(code[0] / 255.0), linear(code[1] / 255.0), linear(code[2] / 255.0)};
}

PlainLight PlainColor::shade(const Point& point, const Directions& d) const {
  const Eigen::Vector3d from = point.position + 1e-4 * std::max(0.1, point.depth) * point.normal;
  const Eigen::Vector3d sky = from + lighting_.sky_reach_m * (frame_around(point.normal) * d.sky);
  const Verdict no_sky = scene_.occluded(from.cast<float>(), sky.cast<float>());
  double light =
      lighting_.exposure * (1 - lighting_.lamp_share) * (no_sky.hit ? lighting_.bounce : 1.0);
  bool close_call = no_sky.close_call;

  const Eigen::Vector3d lamp = on_lamp(d.on_lamp);
  const bool above = (lamp - from).dot(point.normal) > 0;  // light that is below is left out anyway
  const Verdict no_lamp = scene_.occluded(from.cast<float>(), lamp.cast<float>());
  if (!above || !no_lamp.hit) light += lamp_light(from, point.normal);
  close_call |= above && no_lamp.close_call;
  close_call |= std::abs((lamp - from).dot(point.normal)) < kCloseCall;
  return {light * point.color, close_call};
}

}  // namespace vantage::test
