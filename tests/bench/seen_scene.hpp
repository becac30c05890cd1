#pragma once

#include <vector>

#include "vantage/raycore/advanced/visibility_mesh.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/depth_image.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::bench {

/// The work area: half a metre of floor, 20 cm high, with five cubes on it.
Box seen_box();

/// What four cameras of 640×480 pixels around it measured, with noise that grows with the square of
/// the depth (1 mm at 0.8 m).
std::vector<PosedDepth> seen_images();

/// The same at every `step`-th pixel and the last one, with other noise.
std::vector<VisibilityMesh> seen_lattices(int step);

/// 40 cameras of 160×120 pixels on a half-sphere around it.
std::vector<PinholeCamera> seen_viewers();

/// A lattice's volume as a closed mesh that looks outwards. Every depth has to be known.
TriangleMesh visibility_mesh(const VisibilityMesh& lattice);

}  // namespace vantage::bench
