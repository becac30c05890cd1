#pragma once

#include <span>

#include "vantage/raycore/advanced/visibility_mesh.hpp"
#include "vantage/volume/grid_geometry.hpp"

namespace vantage::test {

/// What a lattice says of a point by asking it, and whether it says another thing a hair's breadth
/// beside it.
struct PlainSeen {
  bool seen = false;
  bool close_call = false;
};

/// The slow, obvious twin of `carve`: every lattice is asked about every voxel's centre.
PlainSeen plain_seen(std::span<const VisibilityMesh> lattices, const Eigen::Vector3d& p_world);

/// Whether a point is before a lattice's camera and in the rectangle of its pixels.
PlainSeen plain_covered(std::span<const VisibilityMesh> lattices, const Eigen::Vector3d& p_world);

}  // namespace vantage::test
