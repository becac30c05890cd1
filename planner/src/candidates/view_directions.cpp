#include "candidates/view_directions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "vantage/raycore/error.hpp"

namespace vantage::planner::detail {
namespace {

constexpr double kPi = std::numbers::pi;

/// Shares `total` out in proportion to the weights: each gets its quota rounded down, the largest
/// remainders one more.
std::vector<int> apportion(int total, const std::vector<double>& weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::vector<int> shares(weights.size());
  std::vector<double> remainders(weights.size());
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double quota = total * weights[i] / sum;
    shares[i] = int(quota);
    remainders[i] = quota - shares[i];
  }
  int left = total - std::accumulate(shares.begin(), shares.end(), 0);
  for (; left > 0; --left) {
    const auto largest = std::max_element(remainders.begin(), remainders.end());
    ++shares[std::size_t(largest - remainders.begin())];
    *largest = -1;
  }
  return shares;
}

Pose looking_at_or_down(const Eigen::Vector3d& eye, const Eigen::Vector3d& target) {
  const bool nowhere_to_look = (target - eye).isZero(0);
  return Pose::looking_at(eye, nowhere_to_look ? eye - Eigen::Vector3d::UnitZ() : target);
}

}  // namespace

std::vector<Eigen::Vector3d> directions_in_rings(int count, double polar_rad) {
  // Every point gets the same area, and rings are as far apart as the points on them. Sharing out
  // instead of rounding makes the total exact.
  const double spacing = std::sqrt(2 * kPi * (1 - std::cos(polar_rad)) / count);
  const int rings = std::max(1, int(std::lround(polar_rad / spacing)));
  const auto polar = [&](int ring) { return polar_rad * (ring + 0.5) / rings; };
  std::vector<double> circumferences;
  circumferences.reserve(std::size_t(rings));
  for (int ring = 0; ring < rings; ++ring) circumferences.push_back(std::sin(polar(ring)));
  const std::vector<int> points = apportion(count, circumferences);

  std::vector<Eigen::Vector3d> directions;
  directions.reserve(std::size_t(count));
  for (int ring = 0; ring < rings; ++ring) {
    const double sine = std::sin(polar(ring)), cosine = std::cos(polar(ring));
    for (int i = 0; i < points[std::size_t(ring)]; ++i) {
      const double azimuth = 2 * kPi * i / points[std::size_t(ring)];
      directions.emplace_back(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
    }
  }
  return directions;
}

std::int64_t fan_size(const ViewFan& fan) {
  return 1 + 4 * std::int64_t(fan.rings) * (fan.rings + 1);
}

void add_fan(const Eigen::Vector3d& eye, const Eigen::Vector3d& target, const ViewFan& fan,
             std::vector<ViewCandidate>& candidates) {
  const auto add = [&](const Pose& pose) { candidates.push_back({int(candidates.size()), pose}); };
  const Pose straight = looking_at_or_down(eye, target);
  const Eigen::Matrix3d& axes = straight.rotation();
  add(straight);
  for (int ring = 1; ring <= fan.rings; ++ring) {
    const double off_axis = ring * fan.step_rad;
    for (int i = 0; i < 8 * ring; ++i) {
      const double around = 2 * kPi * i / (8 * ring);
      const Eigen::Vector3d in_camera(std::sin(off_axis) * std::cos(around),
                                      std::sin(off_axis) * std::sin(around), std::cos(off_axis));
      add(Pose::looking_at(eye, eye + axes * in_camera));
    }
  }
}

namespace {

Pose interpolated(const Pose& from, const Pose& to, double share) {
  return Pose::from_quaternion(
      from.quaternion().slerp(share, to.quaternion()),
      from.translation() + share * (to.translation() - from.translation()));
}

double way_between(const Pose& from, const Pose& to) {
  return (to.translation() - from.translation()).norm();
}

double length_of(const std::vector<Pose>& path) {
  double length = 0;
  for (std::size_t i = 1; i < path.size(); ++i) length += way_between(path[i - 1], path[i]);
  return length;
}

}  // namespace

std::vector<Pose> poses_along(const std::vector<Pose>& path, double step_m, std::int64_t most) {
  if (path.empty()) throw bad_input("candidates", "the path has no poses; expected at least one");
  const double length = length_of(path);
  if (!(length / step_m <= double(most))) {
    throw bad_input("candidates",
                    fmt::format("a step of {} m on a path of {:.6g} m gives {:.3g} places; at most "
                                "{} views are handled: use longer steps",
                                step_m, length, length / step_m, most));
  }
  std::vector<Pose> poses = {path.front()};
  double done = 0;  // the way to the segment's begin
  for (std::size_t i = 1; i < path.size(); ++i) {
    const double way = way_between(path[i - 1], path[i]);
    // Multiples of the step instead of sums: no rounding adds up. What is on the path's end but for
    // rounding is its end.
    while (double(poses.size()) * step_m <= done + way &&
           double(poses.size()) * step_m < length * (1 - 1e-9)) {
      const double share = (double(poses.size()) * step_m - done) / way;
      poses.push_back(interpolated(path[i - 1], path[i], share));
    }
    done += way;
  }
  if (path.size() > 1) poses.push_back(path.back());
  return poses;
}

}  // namespace vantage::planner::detail
