#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <variant>
#include <vector>

#include "vantage/raycore/box.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// A pose that the movable camera could take.
struct ViewCandidate {
  int id = 0;
  Pose T_world_cam;
};

/// Directions of view from one position: towards the work area's centre, and in rings around that,
/// 8 in the first, 16 in the second …, `step_rad` apart. Two rings make 25 directions.
struct ViewFan {
  int rings = 0;
  double step_rad = 0.17453292519943295;  ///< 10°
};

/// Positions on half-spheres around the work area's centre (thesis 7.2.1), each half-sphere turned
/// by the golden angle against the one before.
struct HalfSpheres {
  std::vector<double> radii_m = {};  ///< empty: `default_radii_m`, two of them, or one per count
  std::vector<int> counts = {20};  ///< positions: one number for all half-spheres, or one for each
  ViewFan fan = {};
};

/// The thesis' sets: `production` is 2 × 20 positions that look at the centre, `full` 1,369 on
/// three half-spheres, with 25 directions each: 34,225 views.
VANTAGE_API HalfSpheres production_views();
VANTAGE_API HalfSpheres full_views();

/// The same set with its radii, and with one count for each of them.
/// @throws Error bad_input as `view_candidates` does.
VANTAGE_API HalfSpheres resolve_defaults(HalfSpheres set, const Box& work_area);

/// Positions in a box, world frame: counts.x() × counts.y() × counts.z() of them, from face to face
/// (in the middle, along an axis with one).
struct BoxGrid {
  Box box;
  Eigen::Vector3i counts = {1, 1, 1};
  ViewFan fan = {};
};

/// Poses around a path that the robot goes along anyway: at every `step_m` of the way and at its
/// ends the pose itself (interpolated), and `count` poses on a sphere of `radius_m` around it that
/// look at the work area's centre.
struct AroundPath {
  std::vector<Pose> path = {};  ///< T_world_cam, at least one
  double step_m = 0.05;
  double radius_m = 0.05;
  int count = 6;
};

/// Poses from somewhere else, in their order. Those that share a position are scored faster if they
/// follow each other.
struct ViewList {
  std::vector<Pose> poses = {};
};

using CandidateSet = std::variant<HalfSpheres, BoxGrid, AroundPath, ViewList>;

/// The candidates of a set; ids count up from 0, and those of a fan follow each other. A position
/// in the work area's very centre looks straight down.
/// @throws Error bad_input for counts that are not positive or make more than 4,000,000 views,
/// radii and steps that are not positive and finite, fans of more than 50 rings or wider than π, a
/// list or path without poses, positions more than 1e6 m from the world's origin.
VANTAGE_API std::vector<ViewCandidate> view_candidates(const CandidateSet& set,
                                                       const Box& work_area);

/// How many there are, without making them.
/// @throws Error bad_input as `view_candidates` does, but for their positions.
VANTAGE_API std::size_t view_count(const CandidateSet& set, const Box& work_area);

/// `count` unit vectors with z > 0, spread evenly over the half-sphere: rings of equal polar
/// distance, with points in proportion to each ring's circumference (M. Deserno, "How to generate
/// equidistributed points on the surface of a sphere", 2004). From the zenith down.
/// @throws Error bad_input unless 1 <= count <= 1,000,000.
VANTAGE_API std::vector<Eigen::Vector3d> half_sphere_directions(int count);

/// Radii of half-spheres around the work area's centre that keep the camera outside it, and its
/// whole extent in a usual camera's view from the outer one: evenly spaced from 1.5 to 2.5 times
/// half its diagonal; for one, 2 times.
VANTAGE_API std::vector<double> default_radii_m(const Box& work_area, int count = 2);

}  // namespace vantage
