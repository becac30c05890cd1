#pragma once

#include <Eigen/Core>
#include <vector>

#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage {

struct MassProperties {
  double volume_m3 = 0;
  Eigen::Vector3d centre =
      Eigen::Vector3d::Zero();  ///< of mass, at even density, in the mesh's frame
};

/// Of the body that a closed mesh bounds. Parts that overlap count twice, and faces that look
/// inwards bound a hollow.
/// @throws Error bad_input for a mesh that is open, flat or empty, or whose faces look inwards.
MassProperties mass_properties(const TriangleMesh& mesh);

/// The corners of its triangles, each once. A mesh's own list may have more than these.
std::vector<Eigen::Vector3d> surface_points(const TriangleMesh& mesh);

}  // namespace vantage
