#pragma once

#include <memory>
#include <vector>

#include "objects/mesh_topology.hpp"
#include "vantage/raycore/pose.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::volume::detail {

/// A known object's mesh, and where it stands in the grid's frame.
struct PlacedMesh {
  std::shared_ptr<const TriangleMesh> mesh;
  std::shared_ptr<const MeshTopology> topology;  ///< shared by all copies of a mesh
  Pose T_grid_mesh;
};

/// The triangles of a placed mesh in the grid's frame, rounded as `TriangleMesh::transformed` does.
struct PlacedTriangles {
  std::vector<Eigen::Vector3f> vertices;
  const std::vector<Triangle>& triangles;

  explicit PlacedTriangles(const PlacedMesh& placed)
      : PlacedTriangles(placed.mesh->vertices(), placed.mesh->triangles(), placed.T_grid_mesh) {}

  /// @param triangles_in_mesh  have to outlive this.
  PlacedTriangles(const std::vector<Eigen::Vector3f>& vertices_in_mesh,
                  const std::vector<Triangle>& triangles_in_mesh, const Pose& T_grid_mesh)
      : triangles(triangles_in_mesh) {
    vertices.reserve(vertices_in_mesh.size());
    for (const Eigen::Vector3f& p : vertices_in_mesh) {
      vertices.push_back((T_grid_mesh * p.cast<double>()).cast<float>());
    }
  }
  const Eigen::Vector3f& corner(std::size_t triangle, std::size_t corner) const {
    return vertices[triangles[triangle][corner]];
  }
};

}  // namespace vantage::volume::detail
