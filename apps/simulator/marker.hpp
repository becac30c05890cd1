#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "simulator/textured_mesh.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// A square ArUco marker on an object. Its frame is OpenCV's: the origin is its centre, x points to
/// its right, y up, z out of the surface.
struct Marker {
  std::string
      dictionary;  ///< OpenCV's name without the prefix, e.g. "4X4_50", "6X6_250", "ARUCO_ORIGINAL"
  int id = 0;
  double size_m = 0;  ///< edge of the black square
  Pose T_object_marker;

  /// Upper left, upper right, lower right, lower left, in the object's frame: OpenCV's order.
  std::array<Eigen::Vector3d, 4> corners() const;
};

/// The cells of a marker row by row from the upper left, the black border of one cell included:
/// true is white.
struct MarkerCells {
  int side = 0;  ///< cells along an edge, border included
  std::vector<bool> white;
};

/// Names of all dictionaries that `marker_cells` knows: those that OpenCV has had since 4.6.
std::vector<std::string> marker_dictionaries();

/// @throws Error bad_input, `where` as the place, for a dictionary that OpenCV does not have
/// (naming those that it has) and an id outside of it.
MarkerCells marker_cells(const std::string& dictionary, int id, const std::string& where);

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
