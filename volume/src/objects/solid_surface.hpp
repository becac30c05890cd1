#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::volume::detail {

/// What tells inside from outside.
enum class Closure {
  oriented,  ///< every edge is passed as often in one direction as in the other: winding numbers
  even,      ///< every edge has an even number of triangles, but some look inwards: parity
  open,      ///< neither: the generalized winding number has to decide
};

/// How the edges of a mesh are passed. Vertices are those of the mesh, or the first at their place.
struct EdgeBalance {
  std::size_t edges = 0;
  std::size_t odd = 0;         ///< edges with an odd number of triangles
  std::size_t unbalanced = 0;  ///< passed more often in one direction than in the other

  explicit EdgeBalance(const std::vector<Triangle>& triangles);
  Closure closure() const {
    return unbalanced == 0 ? Closure::oriented : odd == 0 ? Closure::even : Closure::open;
  }
};

/// A mesh as it was meant: without the cracks, and the faces that are there twice.
struct SolidSurface {
  std::vector<Eigen::Vector3f> vertices;
  std::vector<Triangle> triangles;
  std::size_t unexplained_pairs = 0;  ///< faces that look both ways and cannot be told apart
};

/// For each vertex the first one within `distance` that stands for itself; 0: at the same place.
std::vector<std::uint32_t> welded(const std::vector<Eigen::Vector3f>& vertices, float distance);

/// Vertices closer than a millionth of the mesh's size become one, and what thereby loses its area
/// goes. Of faces that are there several times, one stays. Of pairs that look both ways,
/// - those that make a surface of their own (a solid of double faces, a sheet): one of each, so
/// that
///   they look outwards;
/// - those that fill a hole of the rest (a solid with one double face): the ones that close it;
/// - others (a wall between two parts, a fin on a solid): none, as both together change no winding
///   number.
/// @param weld_near whether vertices that are near become one, or only those at the same place.
SolidSurface solid_surface(const TriangleMesh& mesh, bool weld_near);

}  // namespace vantage::volume::detail
