#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "vantage/raycore/api.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage {

/// A pose that the movable camera could take.
struct ViewCandidate {
  int id = 0;
  Pose T_world_cam;
};

/// `count` unit vectors with z > 0, spread evenly over the half-sphere: rings of equal polar
/// distance, with points in proportion to each ring's circumference (M. Deserno, "How to generate
/// equidistributed points on the surface of a sphere", 2004). From the zenith down.
/// @throws Error bad_input unless 1 <= count <= 1,000,000.
VANTAGE_API std::vector<Eigen::Vector3d> half_sphere_directions(int count);

/// Radii of two half-spheres around the work area's centre that keep the camera outside it, and its
/// whole extent in a usual camera's view from the outer one: 1.5 and 2.5 times half its diagonal.
VANTAGE_API std::vector<double> default_radii_m(const Box& work_area);

/// Cameras on half-spheres that look at `centre` (thesis 7.2.1). With two radii and a count of 20
/// it is the thesis' production set. Ids count up from 0, half-sphere by half-sphere.
/// @throws Error bad_input for a radius that is not positive and finite, or a wrong count.
VANTAGE_API std::vector<ViewCandidate> half_sphere_candidates(const Eigen::Vector3d& centre,
                                                              const std::vector<double>& radii_m,
                                                              int count_per_half_sphere);

/// Where the robot can bring the camera's centre: a spherical shell around its base, world frame.
struct Reach {
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();
  double min_m = 0;
  double max_m = 0;

  /// @throws Error bad_input unless all is finite and 0 <= min_m < max_m.
  VANTAGE_API void check(std::string_view where) const;
};

/// Why a camera cannot be at a pose; nothing if it can. The reasons are `below the floor` (z <= 0),
/// `out of reach`, `inside occupied volume` and `inside shadow`, tested in this order.
VANTAGE_API std::optional<std::string> reason_to_reject(const ViewCandidate& candidate,
                                                        const std::optional<Reach>& reach,
                                                        const StateGrid& grid);

}  // namespace vantage
