#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/lens.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage {

/// An edge of a mesh with the faces at its sides.
struct MeshEdge {
  Eigen::Vector3d from, to;
  std::vector<Eigen::Vector3d>
      normals;  ///< one for each face; more than two where faces meet badly
};

/// The edges of a mesh; corners at the same place count as one.
std::vector<MeshEdge> edges_of(const TriangleMesh& mesh);

/// A part of an object's outline on the image, pixels.
struct OutlinePiece {
  Eigen::Vector2d from, to;
  bool visible = true;  ///< false: behind something else
};

/// An object's line drawing: its sharp edges and its silhouette, as the camera sees them through
/// its lens. Pieces are short: under a lens straight lines are curved.
/// @param scene all that may hide something.
std::vector<OutlinePiece> outline(const std::vector<MeshEdge>& edges, const Pose& T_world_object,
                                  const Lens& lens, const Pose& T_world_cam, const Scene& scene);

}  // namespace vantage
