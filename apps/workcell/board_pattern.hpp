#pragma once

#include <Eigen/Core>
#include <vector>

#include "documents/document_value.hpp"
#include "vantage/reconstruction/marker.hpp"

namespace vantage {

/// The markers of one of OpenCV's boards, its middle at the origin, x to the right, y up, z out of
/// it. Ids count from the upper left marker, row by row.
struct BoardPattern {
  Eigen::Vector2d size_m;
  std::vector<Marker> markers;
};

/// `charuco` of the workcell's schema: markers in the white squares of a checkerboard. The upper
/// left square is black; on a legacy board of an even number of rows it is white.
/// @throws Error bad_input with the key for markers that do not fit their squares, and for more
/// than the dictionary has.
BoardPattern read_charuco(const Value& value);

/// `grid`: markers in rows and columns with gaps between.
/// @throws Error bad_input for more markers than the dictionary has.
BoardPattern read_grid(const Value& value);

}  // namespace vantage
