#include "vantage/planner/view_candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMostDirections = 1'000'000;

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

}  // namespace

std::vector<Eigen::Vector3d> half_sphere_directions(int count) {
  if (count < 1 || count > kMostDirections) {
    throw bad_input("candidates", fmt::format("{} positions on a half-sphere; expected 1 to {}",
                                              count, kMostDirections));
  }
  // Deserno: every point gets the area 4π/N of the sphere, here 2π/count, and rings are as far
  // apart as the points on them. Sharing out instead of rounding makes the total exact.
  const double spacing = std::sqrt(2 * kPi / count);
  const int rings = std::max(1, int(std::lround(kPi / 2 / spacing)));
  std::vector<double> circumferences;
  circumferences.reserve(std::size_t(rings));
  for (int ring = 0; ring < rings; ++ring) {
    circumferences.push_back(std::sin(kPi / 2 * (ring + 0.5) / rings));
  }
  const std::vector<int> points = apportion(count, circumferences);

  std::vector<Eigen::Vector3d> directions;
  for (int ring = 0; ring < rings; ++ring) {
    const double polar = kPi / 2 * (ring + 0.5) / rings;
    for (int i = 0; i < points[std::size_t(ring)]; ++i) {
      const double azimuth = 2 * kPi * i / points[std::size_t(ring)];
      directions.emplace_back(std::sin(polar) * std::cos(azimuth),
                              std::sin(polar) * std::sin(azimuth), std::cos(polar));
    }
  }
  return directions;
}

std::vector<double> default_radii_m(const Box& work_area) {
  const double half_diagonal = 0.5 * work_area.size().norm();
  return {1.5 * half_diagonal, 2.5 * half_diagonal};
}

std::vector<ViewCandidate> half_sphere_candidates(const Eigen::Vector3d& centre,
                                                  const std::vector<double>& radii_m,
                                                  int count_per_half_sphere) {
  const std::vector<Eigen::Vector3d> directions = half_sphere_directions(count_per_half_sphere);
  std::vector<ViewCandidate> candidates;
  for (const double radius : radii_m) {
    if (!(std::isfinite(radius) && radius > 0)) {
      throw bad_input(
          "candidates",
          fmt::format("a half-sphere of radius {} m; expected a number above 0", radius));
    }
    for (const Eigen::Vector3d& direction : directions) {
      candidates.push_back(
          {int(candidates.size()), Pose::looking_at(centre + radius * direction, centre)});
    }
  }
  return candidates;
}

void Reach::check(std::string_view where) const {
  if (base_m.allFinite() && std::isfinite(max_m) && min_m >= 0 && min_m < max_m) return;
  throw bad_input(std::string(where),
                  fmt::format("the reach goes from {} to {} m around [{}, {}, {}]; expected finite "
                              "numbers with 0 <= min < max",
                              min_m, max_m, base_m.x(), base_m.y(), base_m.z()));
}

std::optional<std::string> reason_to_reject(const ViewCandidate& candidate,
                                            const std::optional<Reach>& reach,
                                            const StateGrid& grid) {
  const Eigen::Vector3d& centre = candidate.T_world_cam.translation();
  if (centre.z() <= 0) return "below the floor";
  if (reach) {
    const double distance = (centre - reach->base_m).norm();
    if (distance < reach->min_m || distance > reach->max_m) return "out of reach";
  }
  if (const auto voxel = grid.geometry().voxel_at(centre)) {
    if (grid.at(*voxel) == VoxelState::occupied) return "inside occupied volume";
    if (grid.at(*voxel) == VoxelState::shadow) return "inside shadow";
  }
  return std::nullopt;
}

}  // namespace vantage
