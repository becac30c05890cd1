#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/expected_gain.hpp"
#include "vantage/raycore/advanced/scene.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage::planner::detail {

/// Cubes of a few voxels each, over the work area: fine enough for estimates.
struct ShadowCells {
  Eigen::Vector3d origin;
  double voxel_m, cell_m;
  Eigen::Vector3i size;
  std::vector<std::uint8_t> unseen;  ///< the share of shadow in a cell, in 255ths; z fastest
  std::vector<std::uint8_t> solid;   ///< the probability that it is inside an unknown thing, alike

  /// All of it seen.
  explicit ShadowCells(const GridGeometry& grid);

  Eigen::Vector3d corner() const { return origin + cell_m * size.cast<double>(); }  ///< the upper

  /// Of a point inside, or near the border by rounding.
  std::size_t index_of(const Eigen::Vector3d& p_world) const;
};

/// Of pixels that may have a reading, how many have one.
struct ReadingRate {
  std::uint32_t readings = 0, pixels = 0;

  double share(double without_pixels) const {
    return pixels == 0 ? without_pixels : double(readings) / double(pixels);
  }
};

/// How often the given images have a reading of the floor, by place.
class FloorRates {
 public:
  explicit FloorRates(const Eigen::Vector2d& middle);
  void add(const Eigen::Vector2d& at, bool reading);

  /// Of the region around a place, if enough pixels looked there, else of all of the floor.
  double at(const Eigen::Vector2d& place) const;

 private:
  static constexpr int kCells = 48;
  static constexpr double kCellM = 0.25;
  std::optional<std::size_t> cell_of(const Eigen::Vector2d& at) const;

  Eigen::Vector2d corner_;
  std::vector<ReadingRate> cells_;
  ReadingRate all_;
};

/// What the given images tell about places that they do not show.
struct LearnedRates {
  double hazard_per_m = 0;  ///< how often a ray through the work area meets something unknown
  FloorRates floor;
  ReadingRate beyond;  ///< of pixels whose rays meet neither the floor nor anything known
};

/// Everything that the expected gain is computed from, except the view. Immutable.
struct UnseenModel {
  StereoSensor sensor;
  ShadowCells cells;
  LearnedRates rates;
  /// The scene's occluders, then one object with what was measured beyond the work area.
  std::shared_ptr<const Scene> surfaces;
  ObjectId measured = kNoObject;  ///< the faces of measured voxels
  ObjectId background = kNoObject;
  double voxel_m = 0;
  std::optional<double> floor_z_m;
  double half_band_1m = 0;       ///< half of a measured surface's thickness at a depth of 1 m
  bool nothing_unknown = false;  ///< no ray is ever stopped by something unknown
  bool ideal = false;            ///< the sensor measures whatever it has in sight

  UnseenModel(const PlanningScene& scene, const WorldModel& world, const VolumeOptions& volume,
              const ExpectedGainOptions& options);

  /// Whether a voxel in sight is certain to be revealed, from wherever it is looked at.
  bool certain() const { return ideal && nothing_unknown; }
};

}  // namespace vantage::planner::detail
