#include "simulator/lens.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr int kMostSteps = 50;      // Newton's method takes 3 or 4
constexpr double kClose = 1e-12;    // on the plane z = 1
constexpr int kStepsPerLine = 32;   // from the principal point to the border
constexpr int kBetweenSteps = 8;    // looks between two such steps
constexpr double kLineSpacing = 8;  // pixels along the border

Error folds(const Distortion& d, double u, double v) {
  return bad_input(
      "color sensor: distortion",
      fmt::format("with k1 = {}, k2 = {}, p1 = {}, p2 = {}, k3 = {} the image folds "
                  "over before pixel ({:.1f}, {:.1f}); expected coefficients that hold "
                  "up to the border of the image, as a calibration gives whose "
                  "pictures reach its corners",
                  d.k1, d.k2, d.p1, d.p2, d.k3, u, v));
}

}  // namespace

Lens::Lens(const Intrinsics& intrinsics, const Distortion& distortion)
    : k_(intrinsics), d_(distortion) {
  for (const double c : {d_.k1, d_.k2, d_.p1, d_.p2, d_.k3}) {
    if (std::isfinite(c)) continue;
    throw bad_input("color sensor: distortion",
                    fmt::format("a coefficient is {}; expected finite numbers", c));
  }
  const double right = k_.width - 0.5, bottom = k_.height - 0.5;
  const auto along = [](double length, const auto& look) {
    const int lines = int(std::ceil(length / kLineSpacing));
    for (int i = 0; i <= lines; ++i) look(-0.5 + length * i / lines);
  };
  along(k_.width, [&](double u) { check_line_to(u, -0.5), check_line_to(u, bottom); });
  along(k_.height, [&](double v) { check_line_to(-0.5, v), check_line_to(right, v); });
}

Eigen::Vector2d Lens::distort(const Eigen::Vector2d& xy) const {
  const double x = xy.x(), y = xy.y(), r2 = x * x + y * y;
  const double radial = 1 + r2 * (d_.k1 + r2 * (d_.k2 + r2 * d_.k3));
  return {x * radial + 2 * d_.p1 * x * y + d_.p2 * (r2 + 2 * x * x),
          y * radial + d_.p1 * (r2 + 2 * y * y) + 2 * d_.p2 * x * y};
}

Eigen::Matrix2d Lens::slope(const Eigen::Vector2d& xy) const {
  const double x = xy.x(), y = xy.y(), r2 = x * x + y * y;
  const double radial = 1 + r2 * (d_.k1 + r2 * (d_.k2 + r2 * d_.k3));
  const double by_r2 = d_.k1 + r2 * (2 * d_.k2 + r2 * 3 * d_.k3);
  const double mixed = 2 * x * y * by_r2 + 2 * d_.p1 * x + 2 * d_.p2 * y;
  Eigen::Matrix2d result;
  result << radial + 2 * x * x * by_r2 + 2 * d_.p1 * y + 6 * d_.p2 * x, mixed, mixed,
      radial + 2 * y * y * by_r2 + 6 * d_.p1 * y + 2 * d_.p2 * x;
  return result;
}

bool Lens::undistort(const Eigen::Vector2d& distorted, Eigen::Vector2d& xy) const {
  for (int step = 0; step < kMostSteps; ++step) {
    const Eigen::Vector2d off = distort(xy) - distorted;
    const Eigen::Matrix2d by_xy = slope(xy);
    if (!(by_xy.determinant() > 0)) return false;
    if (off.norm() < kClose) return true;
    xy -= by_xy.inverse() * off;
  }
  return false;
}

void Lens::check_line_to(double u, double v) const {
  const Eigen::Vector2d border((u - k_.cx) / k_.fx, (v - k_.cy) / k_.fy);
  Eigen::Vector2d from = Eigen::Vector2d::Zero();
  for (int step = 1; step <= kStepsPerLine; ++step) {
    Eigen::Vector2d to = from;
    if (!undistort(border * step / kStepsPerLine, to)) throw folds(d_, u, v);
    // Newton's method may have jumped over a fold and landed behind it.
    for (int i = 1; i < kBetweenSteps; ++i) {
      const Eigen::Vector2d between = from + (to - from) * i / kBetweenSteps;
      if (!(slope(between).determinant() > 0)) throw folds(d_, u, v);
    }
    from = to;
  }
}

PixelSight Lens::sight(double u, double v, const Eigen::Vector2d& guess) const {
  PixelSight result{guess, {}};
  const Eigen::Vector2d distorted((u - k_.cx) / k_.fx, (v - k_.cy) / k_.fy);
  if (!undistort(distorted, result.xy)) throw folds(d_, u, v);
  result.per_pixel = slope(result.xy).inverse();
  result.per_pixel.col(0) /= k_.fx;
  result.per_pixel.col(1) /= k_.fy;
  return result;
}

}  // namespace vantage
