#pragma once

#include <memory>
#include <vector>

#include "reference/box_oracle.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/grid_geometry.hpp"

namespace vantage::bench {

/// Like the thesis' Wall dataset (4.1.1): three cubes of 5 cm in a row on a board, one on top of
/// them, one hidden behind them; a camera from the front and one from the side, without depth.
struct Wall {
  std::vector<test::TurnedBox> cubes;
  std::vector<PinholeCamera> cameras;

  WorldModel model() const;

  /// One flag for each voxel, as the plain algorithm takes it.
  std::vector<char> solid(const GridGeometry& geometry) const;
};
Wall wall();
Box wall_area();  ///< 0.5 × 0.35 × 0.3 m

/// The wall before one camera, and some depth images of it, with noise and holes; the camera has
/// measured the first. Nobody knows the cubes, unless `known`.
struct WallFrames {
  WorldModel world;
  std::vector<std::shared_ptr<const DepthImage>> frames;
};
WallFrames wall_frames(bool known);

/// A table of 2 × 2 m with 30 boxes, 20 of them known, and four 640 × 480 depth images from its
/// corners, with noise and holes.
WorldModel cell();
Box cell_area();  ///< 2 × 2 × 1 m

/// 500 copies of one mesh of 20,480 triangles in the cell, under four cameras without depth.
WorldModel many_objects();

}  // namespace vantage::bench
