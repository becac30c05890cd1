#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "objects/solid_surface.hpp"
#include "objects/winding_number.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::volume::detail {

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

/// How the triangles of a mesh are connected. Vertices at the very same place are one: STL files
/// and textured meshes repeat them.
struct MeshTopology {
  std::vector<MeshEdge> edges;
  std::size_t unmatched_edges = 0;  ///< those that keep the mesh from being closed
  Closure closure = Closure::open;
  std::vector<FacePlane> planes;  ///< of the triangles

  /// What decides inside; null for a closed mesh as it is.
  std::shared_ptr<const SolidSurface> solid;
  /// Of an open surface, and those of its triangles that have no inside: on neither or on both of
  /// their sides the winding number is that of an inside.
  std::shared_ptr<const WindingNumber> winding;
  std::vector<Triangle> sheets;

  explicit MeshTopology(const TriangleMesh& mesh);

 private:
  void decide_inside(const TriangleMesh& mesh, bool faces_are_paired);
};

}  // namespace vantage::volume::detail
