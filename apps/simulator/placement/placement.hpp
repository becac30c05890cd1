#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "vantage/raycore/box.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/raycore/triangle_mesh.hpp"
#include "vantage/raycore/world_model.hpp"

namespace vantage {

/// How a body can lie on a horizontal floor without moving, up to a turn around the vertical.
struct RestingPose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< body → world
  double height_m = 0;  ///< of the body's origin above the floor, when its lowest point touches it
  double share = 0;     ///< how likely a dropped body ends up so; all poses' shares sum to 1
};

/// The stable faces of the mesh's convex hull: those over which the centre of mass lies, of a body
/// of even density. Neighbouring facets of one plane are one face. The likeliest pose comes first.
///
/// The source of the idea: Goldberg et al., "Part pose statistics", 1999. A face's share is its
/// solid angle seen from the centre of mass; that of an unstable face goes to the face on which the
/// body stops after rolling over its edges.
/// @throws Error bad_input for a mesh without volume: open, flat or empty, or turned inside out.
std::vector<RestingPose> resting_poses(const TriangleMesh& mesh);

struct PlacementOptions {
  Box area;  ///< bodies stay inside of it in x and y, and stand on its lower face
  std::uint64_t seed = 0;
  double gap_m = 0.002;  ///< least free distance of a body to others and to `fixed`, any direction;
                         ///< 1e-6 or more
  double upright_share = 0;  ///< 0 to 1: how many bodies keep their mesh's own upright (identity
                             ///< turned around z, to a degree) if it is stable
};

/// Poses T_world_body for bodies that stand or lie still on the floor, inside the area, and touch
/// neither each other nor `fixed`; a body may stand inside a hollow of another. What the bodies
/// stand on is no part of `fixed`, for they touch it.
///
/// Bodies are placed one after the other, at most 2,000 tries for each. Random numbers hash (seed,
/// body, try): the same call gives the same bits, and the first bodies stay where they are when
/// more follow.
/// @throws Error bad_input with the number of bodies placed when there is no room for the next one;
/// for a body that has no resting pose, with its index as the place; for options out of range.
std::vector<Pose> place_at_rest(std::span<const std::shared_ptr<const TriangleMesh>> bodies,
                                std::span<const KnownObject> fixed,
                                const PlacementOptions& options);

}  // namespace vantage
