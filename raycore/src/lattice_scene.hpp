#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#include "embree_device.hpp"
#include "vantage/raycore/depth_lattice.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::detail {

/// A lattice's vertices in the world, and behind them the camera's centre. What is unknown lies
/// there, too: no cell uses it.
std::vector<Eigen::Vector3f> lattice_vertices(const DepthLattice& lattice);

/// The present cells as rectangles of a vertex array with the lattice's width.
std::vector<RTCGrid> present_rectangles(const DepthLattice& lattice);

/// The triangles between the camera's centre, which is vertex `width · height`, and the borders of
/// holes. All look outwards, as the cells do.
std::vector<Triangle> hole_triangles(const DepthLattice& lattice);

/// The bits of a ray's mask that meet a lattice's cells, and the borders of its holes.
inline constexpr unsigned kCellsMask = 1;
inline constexpr unsigned kHolesMask = 2;

/// A surface around what a lattice saw through, as an Embree scene: the cells as grids, the borders
/// of holes as triangles, both on the same vertices, so that no ray slips through between them. At
/// the image's outer borders it is open: those are four planes, and need no triangles, whose long
/// boxes would make every ray through the volume twice as slow.
class LatticeScene {
 public:
  LatticeScene(const EmbreeDevice& device, const DepthLattice& lattice,
               const std::vector<Eigen::Vector3f>& vertices);
  RTCScene get() const { return scene_.get(); }

 private:
  struct Release {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  std::unique_ptr<std::remove_pointer_t<RTCScene>, Release> scene_;
};

}  // namespace vantage::detail
