#include "geometry/fisheye.hpp"

#include <cmath>

namespace vantage::detail {
namespace {

constexpr double kNearAxis = 1e-9;  // on the plane z = 1; nearer, the lens bends nothing
constexpr int kAngleSteps = 1000;   // up to the widest angle
constexpr int kMaxHalvings = 100;   // Newton's method takes 3 or 4
constexpr double kCloseAngle = 1e-14;

}  // namespace

double Fisheye::radius(double angle) const {
  const double t2 = angle * angle;
  return angle * (1 + t2 * (k1_ + t2 * (k2_ + t2 * (k3_ + t2 * k4_))));
}

double Fisheye::radius_by_angle(double angle) const {
  const double t2 = angle * angle;
  return 1 + t2 * (3 * k1_ + t2 * (5 * k2_ + t2 * (7 * k3_ + t2 * 9 * k4_)));
}

double Fisheye::monotone_up_to(double max_angle) const {
  for (int i = 1; i <= kAngleSteps; ++i) {
    if (!(radius_by_angle(max_angle * i / kAngleSteps) > 0)) {
      return max_angle * (i - 1) / kAngleSteps;
    }
  }
  return max_angle;
}

Eigen::Vector2d Fisheye::distort(const Eigen::Vector2d& xy) const {
  const double r = xy.norm();
  return r < kNearAxis ? xy : Eigen::Vector2d(xy * (radius(std::atan(r)) / r));
}

Eigen::Matrix2d Fisheye::slope(const Eigen::Vector2d& xy) const {
  const double r = xy.norm();
  if (r < kNearAxis) return Eigen::Matrix2d::Identity();
  const double angle = std::atan(r);
  const double across = radius(angle) / r;
  const double along = radius_by_angle(angle) / (1 + r * r);
  const Eigen::Vector2d outwards = xy / r;
  return across * Eigen::Matrix2d::Identity() + (along - across) * outwards * outwards.transpose();
}

/// Newton's method, kept between two angles with the wanted one in the middle.
double Fisheye::angle_at(double wanted, double max_angle) const {
  double low = 0, high = max_angle, angle = std::fmin(wanted, max_angle);
  for (int i = 0; i < kMaxHalvings && high - low > kCloseAngle; ++i) {
    const double off = radius(angle) - wanted;
    (off > 0 ? high : low) = angle;
    double next = angle - off / radius_by_angle(angle);
    if (std::abs(next - angle) < kCloseAngle) return angle;
    if (!(next > low && next < high)) next = (low + high) / 2;
    angle = next;
  }
  return angle;
}

bool Fisheye::undistort(const Eigen::Vector2d& distorted, double max_angle,
                        Eigen::Vector2d& xy) const {
  const double r = distorted.norm();
  if (r < kNearAxis) {
    xy = distorted;
    return true;
  }
  if (!(r <= radius(max_angle))) return false;
  xy = distorted * (std::tan(angle_at(r, max_angle)) / r);
  return true;
}

}  // namespace vantage::detail
