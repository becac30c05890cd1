#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "simulator/markers/marker_print.hpp"

namespace vantage::simulator::detail {

/// A marker on a flat face.
struct PrintedMarker {
  std::string place;  ///< for errors
  double size_m = 0;
  MarkerCells cells;
  Pose T_marker_face;
};

/// A flat face of a mesh that carries markers.
struct MarkedFace {
  std::vector<std::uint32_t> triangles;  ///< ascending
  Pose T_object_face;                    ///< z points outwards, x and y as the first marker's
  std::vector<PrintedMarker> markers;
};

/// Finds the face of each marker; faces in the order of their first markers.
/// @throws Error bad_input as `with_markers` does for markers.
std::vector<MarkedFace> marked_faces(const TriangleMesh& mesh, std::span<const Marker> markers,
                                     const std::string& where);

}  // namespace vantage::simulator::detail
