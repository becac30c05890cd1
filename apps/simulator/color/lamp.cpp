#include "simulator/color/lamp.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage {
namespace {

[[gnu::always_inline]] inline void irradiance_body(const std::array<Eigen::Vector3f, 4>& gaussian,
                                                   const Eigen::Vector3f& facing, float scale,
                                                   PointsView position, PointsView normal,
                                                   float* __restrict light) {
  for (std::size_t i = 0; i < position.size; ++i) {
    float sum = 0;
    for (const Eigen::Vector3f& q : gaussian) {
      const float x = q.x() - position.x[i], y = q.y() - position.y[i], z = q.z() - position.z[i];
      const float squared = x * x + y * y + z * z;
      const float here = x * normal.x[i] + y * normal.y[i] + z * normal.z[i];
      const float there = -(x * facing.x() + y * facing.y() + z * facing.z());
      sum += std::max(0.0f, here) * std::max(0.0f, there) / (squared * squared);
    }
    light[i] = scale * sum;
  }
}
constexpr Multiversion<irradiance_body> irradiance;

}  // namespace

Lamp::Lamp(const Lighting& lighting) : centre_(lighting.lamp_centre_m) {
  facing_ = (lighting.lamp_target_m - lighting.lamp_centre_m).normalized();
  const bool hangs_straight = std::abs(facing_.z()) > 0.999f;
  const Eigen::Vector3f up =
      hangs_straight ? Eigen::Vector3f::UnitY() : Eigen::Vector3f::UnitZ().eval();
  side_x_ = lighting.lamp_side_m * facing_.cross(up).normalized();
  side_y_ = side_x_.cross(facing_);
  const float x = 0.5f / std::sqrt(3.0f);
  gaussian_ = {at(-x, -x), at(x, -x), at(-x, x), at(x, x)};
  const Eigen::Vector3f& target = lighting.lamp_target_m;
  const Eigen::Vector3f towards_lamp = -facing_;
  float at_target = 0;
  unshadowed({&target.x(), &target.y(), &target.z(), 1},
             {&towards_lamp.x(), &towards_lamp.y(), &towards_lamp.z(), 1}, &at_target);
  scale_ = lighting.exposure * lighting.lamp_share / at_target;
}

void Lamp::unshadowed(PointsView position, PointsView normal, float* light) const {
  irradiance(gaussian_, facing_, scale_, position, normal, light);
}

}  // namespace vantage
