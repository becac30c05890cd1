#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::simulator::detail {

/// Which triangles of a mesh touch each other, by where their corners lie: meshes from files repeat
/// vertices. Keeps a reference to the mesh.
class FaceFinder {
 public:
  explicit FaceFinder(const TriangleMesh& mesh);

  /// The triangles that lie in the plane of the triangle `seed` and are connected with it, corner
  /// by corner. In ascending order.
  std::vector<std::uint32_t> flat_face(std::uint32_t seed) const;

 private:
  std::span<const std::uint32_t> around(std::uint32_t place) const;

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> place_of_vertex_;
  std::vector<std::uint32_t> first_;  ///< of each place, in `triangles_`; one more at the end
  std::vector<std::uint32_t> triangles_;
};

/// Unit length, outwards.
Eigen::Vector3d normal_of(const TriangleMesh& mesh, std::uint32_t triangle);

double area_of(const TriangleMesh& mesh, std::uint32_t triangle);

/// From a point to the closest one of a triangle.
double distance_to(const TriangleMesh& mesh, std::uint32_t triangle, const Eigen::Vector3d& point);

/// The part of the square |x|, |y| <= half_side that lies inside a triangle of the plane.
double area_inside_square(const std::array<Eigen::Vector2d, 3>& triangle, double half_side);

}  // namespace vantage::simulator::detail
