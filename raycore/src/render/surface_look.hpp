#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>

#include "render/srgb_table.hpp"
#include "vantage/raycore/advanced/picture.hpp"

namespace vantage::raycore::detail {

/// A material with what every hit would compute again: colours as the light that they send back.
class SurfaceLook {
 public:
  explicit SurfaceLook(const Material& material)
      : face_(kExposure * to_linear(material.color)),
        line_(material.line_shade * face_),
        has_lines_(material.line_spacing_m > 0 && material.line_width_m > 0),
        lines_per_m_(has_lines_ ? 1 / material.line_spacing_m : 0),
        half_line_(has_lines_ ? 0.5f * material.line_width_m / material.line_spacing_m : 0),
        line_origin_(material.line_origin),
        fades_(std::isfinite(material.fade_to_m)),
        fade_from_m_(material.fade_from_m),
        fade_per_m_(fades_ ? 1 / (material.fade_to_m - material.fade_from_m) : 0),
        fade_centre_(material.fade_centre) {}

  bool has_lines() const { return has_lines_; }

  /// Of a surface of which `lines` is the share that lies on lines.
  Eigen::Vector3f color(float lines) const { return face_ + lines * (line_ - face_); }

  /// Whether a point of a face lies on a line. A face that lies in a plane of lines has none of it.
  bool on_line(const Eigen::Vector3f& p, const Eigen::Vector3f& normal) const {
    bool found = false;
    for (int axis = 0; axis < 3; ++axis) {
      const float at = (p[axis] - line_origin_[axis]) * lines_per_m_;
      found |= (from_whole(at) < half_line_) & (std::abs(normal[axis]) <= kAlong);
    }
    return found;
  }

  /// The share of a small part of a face that lies on lines: of its points
  /// `middle` + x `per_x` + y `per_y` at the positions (x, y), which are within 0.5 of 0.
  float line_share(const Eigen::Vector3f& middle, const Eigen::Vector3f& per_x,
                   const Eigen::Vector3f& per_y, const Eigen::Vector3f& normal,
                   std::span<const Eigen::Vector2f> positions) const {
    if (!has_lines_) return 0;
    std::uint64_t found = 0;  // a bit for each position
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(normal[axis]) > kAlong) continue;
      const float at = (middle[axis] - line_origin_[axis]) * lines_per_m_;
      const float x = per_x[axis] * lines_per_m_, y = per_y[axis] * lines_per_m_;
      const float reach = half_line_ + 0.5f * (std::abs(x) + std::abs(y));
      if (from_whole(at) > reach) continue;
      for (std::size_t i = 0; i < positions.size(); ++i) {
        const float there = at + positions[i].x() * x + positions[i].y() * y;
        found |= std::uint64_t(from_whole(there) < half_line_) << i;
      }
    }
    return float(std::popcount(found)) / float(positions.size());
  }

  /// How much of it is dissolved, 0 to 1.
  float faded(const Eigen::Vector3f& p) const {
    if (!fades_) return 0;
    return std::clamp(((p - fade_centre_).norm() - fade_from_m_) * fade_per_m_, 0.0f, 1.0f);
  }

 private:
  static constexpr float kExposure = 1.12f;
  static constexpr float kAlong = 0.7f;  ///< cosine of what lies along a plane of lines

  /// The distance from the nearest whole number, 0 to 0.5. By conversion: std::floor is a call.
  static float from_whole(float x) {
    const float whole = std::abs(x) < 1e6f ? float(int(x + (x < 0 ? -0.5f : 0.5f))) : x;
    return std::abs(x - whole);
  }

  Eigen::Vector3f face_, line_;
  bool has_lines_;
  float lines_per_m_, half_line_;
  Eigen::Vector3f line_origin_;
  bool fades_;
  float fade_from_m_, fade_per_m_;
  Eigen::Vector3f fade_centre_;
};

}  // namespace vantage::raycore::detail
