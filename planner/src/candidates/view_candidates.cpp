#include "vantage/planner/view_candidates.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <numeric>

#include "candidates/view_directions.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kGoldenAngle = kPi * (3 - 2.2360679774997896964);  // √5
constexpr int kMaxDirections = 1'000'000;
constexpr std::int64_t kMaxViews = 4'000'000;
constexpr int kMaxRings = 50;
constexpr double kFarthest_m = 1e6;

template <class... Args>
Error refusal(fmt::format_string<Args...> text, Args&&... args) {
  return bad_input("candidates", fmt::format(text, std::forward<Args>(args)...));
}

void check_positive_length(double length_m, const char* what) {
  if (std::isfinite(length_m) && length_m > 0) return;
  throw refusal("{} of {} m; expected a number above 0", what, length_m);
}

void check_direction_count(int count, const char* where) {
  if (count >= 1 && count <= kMaxDirections) return;
  throw refusal("{} positions on {}; expected 1 to {}", count, where, kMaxDirections);
}

void check_fan(const ViewFan& fan) {
  if (fan.rings < 0 || fan.rings > kMaxRings) {
    throw refusal("{} rings of directions; expected 0 to {}", fan.rings, kMaxRings);
  }
  const bool right = std::isfinite(fan.step_rad) && fan.step_rad > 0;
  if (!right || fan.rings * fan.step_rad > kPi) {
    throw refusal(
        "{} rings of directions, {} rad apart; expected a step above 0, and the last "
        "ring within π of the first direction",
        fan.rings, fan.step_rad);
  }
}

/// Rays are floats: nothing is further out than a mesh may be.
void check_position(const ViewCandidate& view) {
  const Eigen::Vector3d& p = view.T_world_cam.translation();
  if (p.cwiseAbs().maxCoeff() <= kFarthest_m) return;
  throw refusal(
      "view {} is at [{}, {}, {}] m; expected coordinates up to {} m (is the unit right?)", view.id,
      p.x(), p.y(), p.z(), kFarthest_m);
}

/// Before anything is made of them.
std::size_t checked_count(double positions, std::int64_t per_position) {
  if (positions * double(per_position) <= double(kMaxViews)) {
    return std::size_t(positions) * std::size_t(per_position);
  }
  throw refusal("{:.0f} positions with {} views each; at most {} views are handled", positions,
                per_position, kMaxViews);
}

std::size_t count_of(const HalfSpheres& given, const Box& work_area) {
  check_fan(given.fan);
  const HalfSpheres set = resolve_defaults(given, work_area);
  return checked_count(std::accumulate(set.counts.begin(), set.counts.end(), 0.0),
                       planner::detail::fan_size(set.fan));
}

std::vector<ViewCandidate> views_of(const HalfSpheres& given, const Box& work_area) {
  (void)count_of(given, work_area);
  const HalfSpheres set = resolve_defaults(given, work_area);
  const Eigen::Vector3d centre = work_area.centre();
  std::vector<ViewCandidate> views;
  for (std::size_t i = 0; i < set.radii_m.size(); ++i) {
    // Turned against each other, so that half-spheres of one count do not repeat their directions.
    const Eigen::AngleAxisd turn(double(i) * kGoldenAngle, Eigen::Vector3d::UnitZ());
    for (const Eigen::Vector3d& direction : half_sphere_directions(set.counts[i])) {
      planner::detail::add_fan(centre + set.radii_m[i] * (turn * direction), centre, set.fan,
                               views);
    }
  }
  return views;
}

std::size_t count_of(const BoxGrid& grid, const Box&) {
  check_fan(grid.fan);
  if (grid.counts.minCoeff() < 1) {
    throw refusal("a grid of {} x {} x {} positions; expected 1 or more along each axis",
                  grid.counts.x(), grid.counts.y(), grid.counts.z());
  }
  return checked_count(grid.counts.cast<double>().prod(), planner::detail::fan_size(grid.fan));
}

std::vector<ViewCandidate> views_of(const BoxGrid& grid, const Box& work_area) {
  (void)count_of(grid, work_area);
  const auto coordinate = [&](int axis, int i) {
    const double share = grid.counts[axis] == 1 ? 0.5 : double(i) / (grid.counts[axis] - 1);
    return (1 - share) * grid.box.min()[axis] + share * grid.box.max()[axis];
  };
  std::vector<ViewCandidate> views;
  for (int i = 0; i < grid.counts.x(); ++i) {
    for (int j = 0; j < grid.counts.y(); ++j) {
      for (int k = 0; k < grid.counts.z(); ++k) {
        planner::detail::add_fan({coordinate(0, i), coordinate(1, j), coordinate(2, k)},
                                 work_area.centre(), grid.fan, views);
      }
    }
  }
  return views;
}

/// The poses of the path itself, of as many as may be.
std::vector<Pose> places_along(const AroundPath& around) {
  check_positive_length(around.step_m, "a step along the path");
  check_positive_length(around.radius_m, "a sphere around the path with a radius");
  check_direction_count(around.count, "a sphere around the path");
  std::vector<Pose> places = planner::detail::poses_along(around.path, around.step_m, kMaxViews);
  (void)checked_count(double(places.size()), 1 + around.count);
  return places;
}

std::size_t count_of(const AroundPath& around, const Box&) {
  return places_along(around).size() * std::size_t(1 + around.count);
}

std::vector<ViewCandidate> views_of(const AroundPath& around, const Box& work_area) {
  const std::vector<Pose> places = places_along(around);
  const auto directions = planner::detail::directions_in_rings(around.count, kPi);
  std::vector<ViewCandidate> views;
  for (const Pose& place : places) {
    views.push_back({int(views.size()), place});
    for (const Eigen::Vector3d& direction : directions) {
      planner::detail::add_fan(place.translation() + around.radius_m * direction,
                               work_area.centre(), {}, views);
    }
  }
  return views;
}

std::size_t count_of(const ViewList& list, const Box&) {
  if (list.poses.empty()) throw refusal("a list without poses; expected at least one");
  return checked_count(double(list.poses.size()), 1);
}

std::vector<ViewCandidate> views_of(const ViewList& list, const Box& work_area) {
  (void)count_of(list, work_area);
  std::vector<ViewCandidate> views;
  for (const Pose& pose : list.poses) views.push_back({int(views.size()), pose});
  return views;
}

}  // namespace

HalfSpheres production_views() {
  return {};
}

HalfSpheres full_views() {
  return {.counts = {456, 456, 457}, .fan = {.rings = 2}};
}

HalfSpheres resolve_defaults(HalfSpheres set, const Box& work_area) {
  for (const int count : set.counts) check_direction_count(count, "a half-sphere");
  if (set.counts.empty()) throw refusal("no count of positions; expected one, or one per radius");
  if (set.radii_m.empty()) {
    const std::size_t spheres = set.counts.size() == 1 ? 2 : set.counts.size();
    set.radii_m = default_radii_m(work_area, int(spheres));
  }
  if (set.counts.size() == 1) set.counts.resize(set.radii_m.size(), set.counts.front());
  if (set.counts.size() != set.radii_m.size()) {
    throw refusal("{} counts of positions for {} half-spheres; expected one, or one for each",
                  set.counts.size(), set.radii_m.size());
  }
  for (const double radius : set.radii_m)
    check_positive_length(radius, "a half-sphere with a radius");
  return set;
}

std::vector<ViewCandidate> view_candidates(const CandidateSet& set, const Box& work_area) {
  auto views = std::visit([&](const auto& kind) { return views_of(kind, work_area); }, set);
  for (const ViewCandidate& view : views) check_position(view);
  return views;
}

std::size_t view_count(const CandidateSet& set, const Box& work_area) {
  return std::visit([&](const auto& kind) { return count_of(kind, work_area); }, set);
}

std::vector<Eigen::Vector3d> half_sphere_directions(int count) {
  check_direction_count(count, "a half-sphere");
  return planner::detail::directions_in_rings(count, kPi / 2);
}

std::vector<double> default_radii_m(const Box& work_area, int count) {
  if (count < 1) throw refusal("{} half-spheres; expected 1 or more", count);
  const double half_diagonal = 0.5 * work_area.size().norm();
  if (count == 1) return {2 * half_diagonal};
  std::vector<double> radii_m;
  for (int i = 0; i < count; ++i)
    radii_m.push_back((1.5 + double(i) / (count - 1)) * half_diagonal);
  return radii_m;
}

}  // namespace vantage
