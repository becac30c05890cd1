#include "vantage/raycore/lens.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "geometry/fisheye.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr int kMaxSteps = 50;       // Newton's method takes 3 or 4
constexpr double kClose = 1e-12;    // on the plane z = 1
constexpr int kStepsPerLine = 32;   // from the principal point to the border
constexpr int kBetweenSteps = 8;    // looks between two such steps
constexpr double kLineSpacing = 8;  // pixels along the border

std::array<double, 8> coefficients(const Distortion& d) {
  return {d.k1, d.k2, d.p1, d.p2, d.k3, d.k4, d.k5, d.k6};
}

std::string text_of(const Distortion& d) {
  if (d.model == LensModel::fisheye) {
    return fmt::format("k1 to k4 = {}, {}, {}, {} of the fisheye model", d.k1, d.k2, d.k3, d.k4);
  }
  return fmt::format("k1, k2, p1, p2, k3 to k6 = {}", fmt::join(coefficients(d), ", "));
}

Error folds(const std::string& where, const Distortion& d, double u, double v) {
  return bad_input(
      where,
      fmt::format(
          "with {} the image folds over before pixel ({:.1f}, {:.1f}); expected coefficients that "
          "hold up to the border of the image: calibrate with pictures that reach its corners",
          text_of(d), u, v));
}

Error too_wide(const std::string& where, double u, double v) {
  return bad_input(where, fmt::format("pixel ({:.1f}, {:.1f}) is more than {:.0f}° off the optical "
                                      "axis, where fisheye images are not used; crop the image",
                                      u, v, Lens::kMaxFisheyeAngle * 57.29577951308232));
}

/// The factor (1 + k1 r² + k2 r⁴ + k3 r⁶) / (1 + k4 r² + k5 r⁴ + k6 r⁶), and its derivative by r².
struct Radial {
  double factor, by_r2;

  Radial(const Distortion& d, double r2) {
    const double above = 1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
    const double below = 1 + r2 * (d.k4 + r2 * (d.k5 + r2 * d.k6));
    const double above_by_r2 = d.k1 + r2 * (2 * d.k2 + r2 * 3 * d.k3);
    const double below_by_r2 = d.k4 + r2 * (2 * d.k5 + r2 * 3 * d.k6);
    factor = above / below;
    by_r2 = (above_by_r2 - factor * below_by_r2) / below;
  }
};

}  // namespace

Lens::Lens(const Intrinsics& intrinsics, const Distortion& distortion, std::string_view where)
    : k_(intrinsics), d_(distortion), where_(where) {
  check_coefficients();
  look_at_border();
}

void Lens::check_coefficients() const {
  for (const double c : coefficients(d_)) {
    if (std::isfinite(c)) continue;
    throw bad_input(where_, fmt::format("a coefficient is {}; expected finite numbers", c));
  }
  if (d_.model == LensModel::fisheye && (d_.p1 != 0 || d_.p2 != 0 || d_.k5 != 0 || d_.k6 != 0)) {
    throw bad_input(
        where_,
        "a fisheye lens has only the coefficients k1 to k4; expected 0 for p1, p2, k5 and k6");
  }
}

void Lens::look_at_border() {
  const bool is_fisheye = d_.model == LensModel::fisheye;
  const double max_angle = is_fisheye ? detail::Fisheye(d_).monotone_up_to(kMaxFisheyeAngle) : 0;
  const auto look_at = [&](double u, double v) {
    is_fisheye ? find_fisheye_reach_at(u, v, max_angle) : follow_line_to(u, v);
  };
  const double right = k_.width - 0.5, bottom = k_.height - 0.5;
  const auto along = [](double length, const auto& look) {
    const int lines = int(std::ceil(length / kLineSpacing));
    for (int i = 0; i <= lines; ++i) look(-0.5 + length * i / lines);
  };
  along(k_.width, [&](double u) { look_at(u, -0.5), look_at(u, bottom); });
  along(k_.height, [&](double v) { look_at(-0.5, v), look_at(right, v); });
}

Eigen::Vector2d Lens::distort(const Eigen::Vector2d& xy) const {
  if (d_.model == LensModel::fisheye) return detail::Fisheye(d_).distort(xy);
  const double x = xy.x(), y = xy.y(), r2 = x * x + y * y;
  const double radial = Radial(d_, r2).factor;
  return {x * radial + 2 * d_.p1 * x * y + d_.p2 * (r2 + 2 * x * x),
          y * radial + d_.p1 * (r2 + 2 * y * y) + 2 * d_.p2 * x * y};
}

Eigen::Matrix2d Lens::slope(const Eigen::Vector2d& xy) const {
  if (d_.model == LensModel::fisheye) return detail::Fisheye(d_).slope(xy);
  const double x = xy.x(), y = xy.y(), r2 = x * x + y * y;
  const auto [radial, by_r2] = Radial(d_, r2);
  const double mixed = 2 * x * y * by_r2 + 2 * d_.p1 * x + 2 * d_.p2 * y;
  Eigen::Matrix2d result;
  result << radial + 2 * x * x * by_r2 + 2 * d_.p1 * y + 6 * d_.p2 * x, mixed, mixed,
      radial + 2 * y * y * by_r2 + 6 * d_.p1 * y + 2 * d_.p2 * x;
  return result;
}

Eigen::Vector2d Lens::project(const Eigen::Vector3d& p_cam) const {
  const Eigen::Vector2d xy = distort(p_cam.head<2>() / p_cam.z());
  return {k_.fx * xy.x() + k_.cx, k_.fy * xy.y() + k_.cy};
}

bool Lens::undistort(const Eigen::Vector2d& distorted, Eigen::Vector2d& xy) const {
  if (d_.model == LensModel::fisheye) {
    return detail::Fisheye(d_).undistort(distorted, kMaxFisheyeAngle, xy);
  }
  for (int step = 0; step < kMaxSteps; ++step) {
    const Eigen::Vector2d off = distort(xy) - distorted;
    const Eigen::Matrix2d by_xy = slope(xy);
    if (!(by_xy.determinant() > 0)) return false;
    if (off.norm() < kClose) return true;
    xy -= by_xy.inverse() * off;
  }
  return false;
}

void Lens::follow_line_to(double u, double v) {
  const Eigen::Vector2d border((u - k_.cx) / k_.fx, (v - k_.cy) / k_.fy);
  Eigen::Vector2d from = d_.none() ? border : Eigen::Vector2d::Zero();
  for (int step = 1; step <= kStepsPerLine && !d_.none(); ++step) {
    Eigen::Vector2d to = from;
    if (!undistort(border * step / kStepsPerLine, to)) throw folds(where_, d_, u, v);
    // Newton's method may have jumped over a fold and landed behind it.
    for (int i = 1; i < kBetweenSteps; ++i) {
      const Eigen::Vector2d between = from + (to - from) * i / kBetweenSteps;
      if (!(slope(between).determinant() > 0)) throw folds(where_, d_, u, v);
    }
    from = to;
  }
  reach_ = std::max(reach_, from.norm());
}

void Lens::find_fisheye_reach_at(double u, double v, double max_angle) {
  const Eigen::Vector2d border((u - k_.cx) / k_.fx, (v - k_.cy) / k_.fy);
  Eigen::Vector2d xy;
  if (detail::Fisheye(d_).undistort(border, max_angle, xy)) {
    reach_ = std::max(reach_, xy.norm());
  } else if (max_angle < kMaxFisheyeAngle) {
    throw folds(where_, d_, u, v);
  } else {
    reach_ = std::tan(kMaxFisheyeAngle);
    covers_image_ = false;
  }
}

PixelSight Lens::sight(double u, double v, const Eigen::Vector2d& guess) const {
  PixelSight result{guess, {}};
  const Eigen::Vector2d distorted((u - k_.cx) / k_.fx, (v - k_.cy) / k_.fy);
  if (!undistort(distorted, result.xy)) {
    throw d_.model == LensModel::fisheye ? too_wide(where_, u, v) : folds(where_, d_, u, v);
  }
  result.per_pixel = slope(result.xy).inverse();
  result.per_pixel.col(0) /= k_.fx;
  result.per_pixel.col(1) /= k_.fy;
  return result;
}

}  // namespace vantage
