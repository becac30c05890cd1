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
  Eigen::Matrix3d rotation;  ///< body → world
  double height_m = 0;       ///< of the body's origin above the floor
  double share = 0;  ///< of the directions in which a body that is dropped ends up so; all sum to 1
};

/// The stable faces of the mesh's convex hull: those over which the centre of mass lies, a body of
/// even density. Neighbouring facets of one plane count as one face. The source of the idea:
/// Goldberg et al., "Part pose statistics", 1999 – shares are the faces' solid angles seen from the
/// centre of mass, and an unstable face's share goes to the face that it rolls over to.
/// @throws Error bad_input for a mesh without volume.
std::vector<RestingPose> resting_poses(const TriangleMesh& mesh);

struct PlacementOptions {
  Box area;  ///< bodies stay inside of it in x and y, and stand on its lower face
  std::uint64_t seed = 0;
  double gap_m = 0.002;      ///< least free distance between bodies, in any direction
  double upright_share = 0;  ///< 0 to 1: how many bodies keep their mesh's own upright (identity
                             ///< turned around z) if it is stable
};

/// Poses T_world_body for bodies that stand or lie still on the floor, inside the area, and touch
/// neither each other nor `fixed`. The same seed gives the same poses.
/// @throws Error bad_input with the number of bodies placed when there is no room for the next one.
std::vector<Pose> place_at_rest(std::span<const std::shared_ptr<const TriangleMesh>> bodies,
                                std::span<const KnownObject> fixed,
                                const PlacementOptions& options);

}  // namespace vantage
