#pragma once

#include <Eigen/Core>
#include <span>
#include <string>

#include "simulator/scene/textured_mesh.hpp"
#include "vantage/reconstruction/marker.hpp"

namespace vantage {

/// The mesh in one colour with markers printed on it, each on a white square that is one cell wider
/// on every side where the face has room for it. Print is no screen: its white is sRGB 0.92, its
/// black 0.06.
///
/// A flat face that carries markers gets a rectangle of the texture, `texel_m` for each texel; all
/// the others point at a spot in the mesh's colour. A texel has the colour of its centre, so that
/// cells end within half a texel's diagonal of where they should; they end exactly there if the
/// marker stands as the face's first one does and all its cells are whole texels wide. Around each
/// face's edges the texture goes on for a texel. Without markers there is no texture.
/// @throws Error bad_input for a marker that does not lie on a flat face of the mesh (centre off by
/// more than 0.1 mm, normal by more than 0.01 rad, or any of it more than 0.1 mm beyond the face's
/// edge) or lies on another one, for a size that is not positive and finite, and as `marker_cells`:
/// `where` and the marker as the place. For a colour outside 0 to 1, and a texture of more than
/// 16384 texels along a side or 2^27 in all.
TexturedMesh with_markers(const TriangleMesh& mesh, const Eigen::Vector3f& color,
                          std::span<const Marker> markers, const std::string& where,
                          double texel_m = 0.00025);

}  // namespace vantage
