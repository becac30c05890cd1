#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "vantage/raycore/scene.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::detail {

/// Triangles and rectangles, ready to be projected into many views. Metres, world frame.
struct FlatFaces {
  struct Face {
    std::array<std::uint32_t, 4>
        corners;             ///< around the face; a triangle's last one is there twice
    Eigen::Vector3d normal;  ///< outwards, of length 1
    double offset_m;         ///< of its plane: normal · p
  };

  std::vector<double> x, y, z;  ///< of the corners
  std::vector<Face> list;
  double largest_coordinate_m = 0;

  /// @param corners a triangle's, or a rectangle's.
  void add(const std::array<Eigen::Vector3d, 4>& corners);
};

/// @param faces as `StateGrid::faces` gives them: two triangles for each rectangle.
FlatFaces rectangles_of(const TriangleMesh& faces);

/// The largest faces of a scene, as many as are worth their cost where they hide something. What is
/// made of very many triangles is left out.
FlatFaces largest_faces_of(const Scene& scene);

}  // namespace vantage::detail
