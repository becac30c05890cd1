#pragma once

#include <cstdint>
#include <vector>

#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::volume::detail {

/// What tells inside from outside.
enum class Closure {
  oriented,  ///< every edge is passed as often in one direction as in the other: winding numbers
  even,      ///< every edge has an even number of triangles, but some look inwards: parity
  open,      ///< neither: the mesh has no inside
};

/// An edge and the triangles at it. `right` is `kNoTriangle` unless exactly two triangles meet at
/// the edge and pass it in opposite directions.
struct MeshEdge {
  std::uint32_t from, to;  ///< vertices
  std::uint32_t left, right;
};
inline constexpr std::uint32_t kNoTriangle = 0xFFFFFFFFu;

/// A triangle's plane in the mesh's frame: a point p is before it where normal · p > offset.
struct FacePlane {
  Eigen::Vector3d normal;  ///< unit length
  double offset;
};

/// How the triangles of a mesh hang together. Vertices at the very same place are one: STL files
/// and textured meshes repeat them.
struct MeshTopology {
  std::vector<MeshEdge> edges;
  std::size_t unmatched_edges = 0;  ///< those that keep the mesh from being closed
  Closure closure = Closure::open;
  std::vector<FacePlane> planes;  ///< of the triangles

  explicit MeshTopology(const TriangleMesh& mesh);
};

}  // namespace vantage::volume::detail
