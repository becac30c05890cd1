#include "reference/plain_instances.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace vantage::test {
namespace {

using Parameters = Eigen::Matrix<double, 6, 1>;  // translation, rotation vector

Pose pose_of(const Parameters& p) {
  const double angle = p.tail<3>().norm();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  if (angle > 0) rotation = Eigen::AngleAxisd(angle, p.tail<3>() / angle).toRotationMatrix();
  return Pose::from_rotation(rotation, p.head<3>());
}

/// Residuals of all points; a point behind its camera is a thousand pixels off.
Eigen::VectorXd residuals(const std::vector<PlainSighting>& all,
                          const std::vector<std::size_t>& chosen, const Parameters& parameters) {
  const Pose T_world_object = pose_of(parameters);
  std::vector<double> values;
  for (const std::size_t s : chosen) {
    const PlainSighting& seen = all[s];
    for (std::size_t i = 0; i < seen.points_m.size(); ++i) {
      const Eigen::Vector3d p = seen.T_world_cam.inverse() * (T_world_object * seen.points_m[i]);
      Eigen::Vector2d off(1000, 1000);
      if (p.z() > 0.01) off = seen.lens->project(p) - seen.pixels[i];
      values.push_back(off.x());
      values.push_back(off.y());
    }
  }
  return Eigen::Map<Eigen::VectorXd>(values.data(), Eigen::Index(values.size()));
}

/// Levenberg–Marquardt with difference quotients.
Parameters minimised(const std::vector<PlainSighting>& all, const std::vector<std::size_t>& chosen,
                     Parameters p) {
  double damping = 1e-3;
  for (int step = 0; step < 40 && damping < 1e8; ++step) {
    const Eigen::VectorXd r = residuals(all, chosen, p);
    Eigen::MatrixXd j(r.size(), 6);
    for (int k = 0; k < 6; ++k) {
      Parameters up = p, down = p;
      up[k] += 1e-6;
      down[k] -= 1e-6;
      j.col(k) = (residuals(all, chosen, up) - residuals(all, chosen, down)) / 2e-6;
    }
    Eigen::MatrixXd normal = j.transpose() * j;
    normal.diagonal() *= 1 + damping;
    const Parameters next = p - Parameters(normal.ldlt().solve(j.transpose() * r));
    const double change = r.squaredNorm() - residuals(all, chosen, next).squaredNorm();
    if (!(change >= 0)) {
      damping *= 10;
      continue;
    }
    p = next;
    damping /= 10;
    if (change < 1e-10) break;
  }
  return p;
}

/// Turned in all the ways of a cube, on the line of sight of the first measurement.
std::vector<Parameters> starts(const PlainSighting& seen) {
  std::vector<Parameters> found;
  const Eigen::Vector3d eye = seen.T_world_cam.translation();
  for (int a = 0; a < 6; ++a) {
    for (int b = 0; b < 6; ++b) {
      if (a / 2 == b / 2) continue;
      Eigen::Matrix3d rotation;
      rotation.col(0) = (a % 2 ? -1 : 1) * Eigen::Vector3d::Unit(a / 2);
      rotation.col(1) = (b % 2 ? -1 : 1) * Eigen::Vector3d::Unit(b / 2);
      rotation.col(2) = rotation.col(0).cross(rotation.col(1));
      const Eigen::AngleAxisd turn(rotation);
      Parameters p;
      p << 0.05 * eye.normalized(), turn.angle() * turn.axis();
      found.push_back(p);
    }
  }
  return found;
}

bool possible(const std::vector<PlainSighting>& all, const std::vector<std::size_t>& chosen) {
  std::set<std::pair<int, int>> places;
  for (const std::size_t s : chosen) places.insert({all[s].view, all[s].feature});
  return places.size() == chosen.size();
}

/// Walks through all ways to divide the measurements; each goes into an object that is there, or
/// into a new one.
struct Divider {
  const std::vector<PlainSighting>& all;
  double inlier_px;
  std::map<std::vector<std::size_t>, std::optional<PlainObject>> fits = {};
  std::vector<PlainObject> best = {};
  double least = std::numeric_limits<double>::infinity();

  void divide(std::size_t next, std::vector<std::vector<std::size_t>>& parts) {
    if (next == all.size()) return judge(parts);
    if (!best.empty() && parts.size() > best.size()) return;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      parts[i].push_back(next);
      if (possible(all, parts[i])) divide(next + 1, parts);
      parts[i].pop_back();
    }
    parts.push_back({next});
    divide(next + 1, parts);
    parts.pop_back();
  }

  void judge(const std::vector<std::vector<std::size_t>>& parts) {
    std::vector<PlainObject> objects;
    double sum = 0;
    for (const auto& part : parts) {
      const auto [place, is_new] = fits.try_emplace(part);
      if (is_new) place->second = plain_fit(all, part, inlier_px);
      if (!place->second) return;
      objects.push_back(*place->second);
      sum += objects.back().squared_px;
    }
    const bool fewer = best.empty() || objects.size() < best.size();
    if (!fewer && !(objects.size() == best.size() && sum < least)) return;
    best = std::move(objects);
    least = sum;
  }
};

}  // namespace

std::optional<PlainObject> plain_fit(const std::vector<PlainSighting>& all,
                                     const std::vector<std::size_t>& measurements,
                                     double inlier_px) {
  if (!possible(all, measurements)) return std::nullopt;
  Parameters best;
  double least = std::numeric_limits<double>::infinity();
  for (const Parameters& start : starts(all[measurements.front()])) {
    const Parameters p = minimised(all, measurements, start);
    const double sum = residuals(all, measurements, p).squaredNorm();
    if (!(sum < least) || p.head<3>().norm() > 0.3) continue;
    least = sum;
    best = p;
  }
  if (!std::isfinite(least)) return std::nullopt;
  for (const std::size_t s : measurements) {
    const double points = double(all[s].points_m.size());
    if (residuals(all, {s}, best).norm() > inlier_px * std::sqrt(points)) return std::nullopt;
  }
  return PlainObject{measurements, pose_of(best), least};
}

std::vector<PlainObject> plain_instances(const std::vector<PlainSighting>& all, double inlier_px) {
  Divider divider{all, inlier_px};
  std::vector<std::vector<std::size_t>> parts;
  divider.divide(0, parts);
  return divider.best;
}

}  // namespace vantage::test
