#include "vantage/planner/view_constraints.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

std::string text(const Eigen::Vector3d& v) {
  return fmt::format("[{}, {}, {}]", v.x(), v.y(), v.z());
}

void check_length(double length_m, const char* where) {
  if (std::isfinite(length_m) && length_m >= 0) return;
  throw bad_input(where, fmt::format("it is {} m; expected 0 or more", length_m));
}

}  // namespace

void Reach::check(std::string_view where) const {
  if (base_m.allFinite() && std::isfinite(max_m) && min_m >= 0 && min_m < max_m) return;
  throw bad_input(std::string(where),
                  fmt::format("the reach goes from {} to {} m around {}; expected finite numbers "
                              "with 0 <= min < max",
                              min_m, max_m, text(base_m)));
}

bool ReachMap::contains(const Eigen::Vector3d& p_world) const {
  const Eigen::Array3d index = ((p_world - origin_m) / cell_m).array().floor();
  if (!((index >= 0).all() && (index < size.array().cast<double>()).all())) return false;
  const auto at = [&](int axis) { return std::size_t(index[axis]); };
  return reachable[(at(0) * std::size_t(size.y()) + at(1)) * std::size_t(size.z()) + at(2)] != 0;
}

void ReachMap::check(std::string_view where) const {
  if (!(origin_m.allFinite() && std::isfinite(cell_m) && cell_m > 0)) {
    throw bad_input(std::string(where),
                    fmt::format("cells of {} m from {} on; expected finite numbers, and cells of "
                                "more than 0 m",
                                cell_m, text(origin_m)));
  }
  if (size.minCoeff() < 1 || size.cast<double>().prod() != double(reachable.size())) {
    throw bad_input(std::string(where),
                    fmt::format("{} values for {} x {} x {} cells; expected at least one cell "
                                "along each axis, and one value for each cell",
                                reachable.size(), size.x(), size.y(), size.z()));
  }
}

void ViewCone::check(std::string_view where) const {
  if (!(axis.allFinite() && axis.stableNorm() > 0)) {
    throw bad_input(std::string(where),
                    fmt::format("its axis is {}; expected a direction", text(axis)));
  }
  if (!(half_angle_rad > 0 && half_angle_rad <= std::numbers::pi)) {
    throw bad_input(std::string(where),
                    fmt::format("its half angle is {} rad; expected more than 0 and at most π",
                                half_angle_rad));
  }
}

BoxBody d435_body() {
  return {Box({-0.045, -0.0125, -0.021}, {0.045, 0.0125, 0.004})};
}

ViewConstraints ViewConstraints::bare() {
  ViewConstraints constraints;
  constraints.clearance_m = 0;
  constraints.body = std::monostate();
  return constraints;
}

void ViewConstraints::check() const {
  if (reach) reach->check("reach");
  if (reach_map) reach_map->check("reach map");
  if (view_cone) view_cone->check("view cone");
  check_length(clearance_m, "clearance");
  if (floor_z_m && !std::isfinite(*floor_z_m)) {
    throw bad_input("floor", fmt::format("its height is {} m; expected a number", *floor_z_m));
  }
  if (const SphereBody* sphere = std::get_if<SphereBody>(&body)) {
    check_length(sphere->radius_m, "radius of the camera's body");
  }
  for (std::size_t i = 0; i < checks.size(); ++i) {
    if (checks[i]) continue;
    throw bad_input("constraints", fmt::format("check {} is empty; expected a function", i));
  }
}

ViewCheck view_check(std::function<bool(const Pose& T_world_cam)> feasible, std::string reason) {
  if (!feasible) throw bad_input("constraints", "the check is empty; expected a function");
  return [feasible = std::move(feasible),
          reason = std::move(reason)](const Pose& T_world_cam) -> std::optional<std::string> {
    if (feasible(T_world_cam)) return std::nullopt;
    return reason;
  };
}

std::string_view to_text(InvalidReason reason) {
  switch (reason) {
    case InvalidReason::none:
      return "none";
    case InvalidReason::below_the_floor:
      return "below the floor";
    case InvalidReason::out_of_reach:
      return "out of reach";
    case InvalidReason::outside_the_view_cone:
      return "outside the view cone";
    case InvalidReason::inside_occupied_volume:
      return "inside occupied volume";
    case InvalidReason::inside_shadow:
      return "inside shadow";
    case InvalidReason::too_close_to_shadow:
      return "too close to shadow";
    case InvalidReason::body_in_unseen:
      return "body in unseen volume";
    case InvalidReason::too_close_to_occupied:
      return "too close to occupied volume";
    case InvalidReason::rejected_by_check:
      return "rejected by a check";
  }
  return "unknown";
}

}  // namespace vantage
