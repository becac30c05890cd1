#pragma once

#include <vector>

#include "reference/random_scene.hpp"
#include "vantage/raycore/advanced/visibility_mesh.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/camera.hpp"

namespace vantage::test {

/// A box near the origin, less than a metre wide, and what up to six cameras around it measured:
/// smooth and jagged surfaces with holes, lines at uneven distances, the same twice, nothing at
/// all, and beside the box.
struct RandomLattices {
  Box box;
  std::vector<VisibilityMesh> lattices;
};

RandomLattices random_lattices(std::uint32_t seed);

/// Where a viewer stands: far from the box or near it, perhaps inside it, in the centre of a
/// lattice's camera, or as that camera itself, with its pixels.
enum class ViewerPlace { outside, inside, apex, lattice_camera };

/// A camera that looks at the box of random_lattices.
PinholeCamera random_viewer(Random& random, const RandomLattices& scene, ViewerPlace place);

}  // namespace vantage::test
