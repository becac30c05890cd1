#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "scene/embree.hpp"
#include "unobserved/lattice_probe.hpp"
#include "vantage/raycore/advanced/visibility_mesh.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::raycore::detail {

/// A lattice's vertices in its probe's projective space. What is unknown has nearness 0: no cell
/// uses it.
std::vector<Eigen::Vector3f> lattice_vertices(const VisibilityMesh& lattice,
                                              const LatticeProbe& probe);

/// The present cells as rectangles of a vertex array with the lattice's width.
std::vector<RTCGrid> present_rectangles(const VisibilityMesh& lattice);

/// The walls at the borders of holes, from the cells' edges upwards to where the camera's centre
/// would be, which is infinitely high: they end at a millionth of the smallest depth. All look
/// outwards, as the cells do. Their upper vertices are added to `vertices`.
std::vector<Triangle> hole_walls(const VisibilityMesh& lattice,
                                 std::vector<Eigen::Vector3f>& vertices);

/// The bits of a ray's mask that meet a lattice's cells, and the borders of its holes.
inline constexpr unsigned kCellsMask = 1;
inline constexpr unsigned kHolesMask = 2;

/// A surface around what a lattice saw through, as an Embree scene in its probe's projective space:
/// the cells as grids, the borders of holes as triangles, both on the same vertices, so that no ray
/// slips through between them. In the world a cell at an edge in depth is a sliver that points away
/// from the camera, in a box that a great many rays meet; here it is an upright wall, and all boxes
/// are tight. At the image's outer borders the surface is open: those are four planes, and need no
/// triangles.
class LatticeScene {
 public:
  LatticeScene(const EmbreeDevice& device, const VisibilityMesh& lattice,
               const LatticeProbe& probe);
  RTCScene get() const { return scene_.get(); }
  bool has_walls() const { return has_walls_; }

 private:
  OwnedScene scene_;
  bool has_walls_;
};

}  // namespace vantage::raycore::detail
