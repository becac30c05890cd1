#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "scoring/expected/unseen_model.hpp"
#include "vantage/raycore/box.hpp"
#include "vantage/raycore/points.hpp"
#include "vantage/raycore/triangle_mesh.hpp"

namespace vantage::planner::detail {

/// A thinned-out depth image beside the depths that the known geometry has at its pixels.
struct GivenDepth {
  PinholeCamera camera;         ///< its pixels are some of the given image's
  std::vector<float> measured;  ///< metres; NaN where there is no reading
  std::vector<float> known;     ///< metres; infinite where a ray meets nothing known
  std::vector<float> width;     ///< of the unknown thing at a pixel, as far as it is seen; metres
  double sigma_1m;              ///< σ of a depth of 1 m; it grows with its square
  double voxel_m;

  double sigma_m(double depth_m) const { return sigma_1m * depth_m * depth_m; }

  /// Whether what was measured is in front of all that is known there, by more than noise explains.
  bool unknown_at(std::size_t pixel) const;
};

/// Of all cameras of the world that have a depth image.
std::vector<GivenDepth> given_depths(const WorldModel& world, const VolumeOptions& volume,
                                     double voxel_m);

/// How often light comes back, and how often something unknown is in the way.
/// @param floor_z_m height of the floor; none: there is no floor.
LearnedRates learned_rates(const std::vector<GivenDepth>& images, const Box& work_area,
                           const std::optional<double>& floor_z_m);

/// What the images show, in the work area and beyond: triangles between neighbouring pixels whose
/// depths belong to one surface.
TriangleMesh background_mesh(const std::vector<GivenDepth>& images);

/// Fills the cells' shares of shadow and probabilities of solid.
/// @param shadow the centres of its voxels.
void fill_cells(PointsView shadow, const std::vector<GivenDepth>& images, double unknown_depth,
                ShadowCells& cells);

}  // namespace vantage::planner::detail
