#pragma once

#include <string>
#include <vector>

#include "simulator/markers/marked_face.hpp"

namespace vantage::simulator::detail {

/// Where a face lies on the texture.
struct Region {
  int u = 0, v = 0, width = 0, height = 0;  ///< texels
  double left_m = 0, top_m = 0;             ///< the region's upper left corner on the face
};

/// The face's bounding rectangle and a texel around it, for those who look up just beyond an edge.
/// Texels begin at the first marker's edges, so that none of its borders runs through texels if
/// its cells are whole texels wide.
/// @throws Error bad_input for a face that takes too many texels.
Region region_for(const TriangleMesh& mesh, const MarkedFace& face, double texel_m);

/// Lays the regions out in rows, as a typesetter does, and returns a black texture of that size.
/// @throws Error bad_input if it would be too large.
ColorImage lay_out(std::vector<Region>& regions, const std::string& where);

}  // namespace vantage::simulator::detail
