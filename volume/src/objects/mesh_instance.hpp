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

  explicit PlacedTriangles(const PlacedMesh& placed) : triangles(placed.mesh->triangles()) {
    vertices.reserve(placed.mesh->vertices().size());
    for (const Eigen::Vector3f& p : placed.mesh->vertices()) {
      vertices.push_back((placed.T_grid_mesh * p.cast<double>()).cast<float>());
    }
  }
  const Eigen::Vector3f& corner(std::size_t triangle, std::size_t corner) const {
    return vertices[triangles[triangle][corner]];
  }
};

}  // namespace vantage::volume::detail
