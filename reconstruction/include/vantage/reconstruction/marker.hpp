#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/pose.hpp"

namespace vantage {

/// A square ArUco marker on an object or a board. Its frame is OpenCV's: the origin is its centre,
/// x points to its right, y up, z out of the surface.
struct Marker {
  std::string
      dictionary;  ///< OpenCV's name without the prefix, e.g. "4X4_50", "6X6_250", "ARUCO_ORIGINAL"
  int id = 0;
  double size_m = 0;  ///< edge of the black square
  Pose T_object_marker;

  /// Upper left, upper right, lower right, lower left, in the object's frame: OpenCV's order.
  VANTAGE_API std::array<Eigen::Vector3d, 4> corners() const;
};

/// The cells of a marker row by row from the upper left, the black border of one cell included:
/// true is white.
struct MarkerCells {
  int side = 0;  ///< cells along an edge, border included
  std::vector<bool> white;
};

/// Names of all dictionaries that `marker_cells` knows: those of OpenCV 4.6, and of the one that
/// vantage is built with.
VANTAGE_API std::vector<std::string> marker_dictionaries();

/// The name as `marker_dictionaries` has it: "4X4_50" for "DICT_4X4_50", "APRILTAG_36h11" for
/// "tag36h11", in upper or lower case. Other names are returned unchanged.
VANTAGE_API std::string marker_dictionary(std::string_view name);

/// "4X4" for 4X4_50 and its family, whose first markers are the same: a camera cannot tell 4X4_50's
/// marker 7 from 4X4_250's. Other names stand for themselves.
VANTAGE_API std::string marker_family(std::string_view dictionary);

/// How many markers a dictionary has; their ids count from 0.
/// @throws Error bad_input, `where` as the place, for a dictionary that OpenCV does not have,
/// naming those that it has.
VANTAGE_API int marker_count(const std::string& dictionary, const std::string& where);

/// @throws Error bad_input, `where` as the place, for a dictionary that OpenCV does not have
/// (naming those that it has) and an id outside of it.
VANTAGE_API MarkerCells marker_cells(const std::string& dictionary, int id,
                                     const std::string& where);

}  // namespace vantage
