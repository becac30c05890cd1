#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reference/box_oracle.hpp"
#include "vantage/planner/advanced/planning_scene.hpp"
#include "vantage/planner/view_candidates.hpp"
#include "vantage/raycore/camera.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage::bench {

/// A workcell of boxes under two cameras without depth, classified, and the camera to be moved.
struct PlannerScene {
  std::string name;
  WorldModel world;
  Box area;
  std::vector<test::TurnedBox> boxes;  ///< the world's objects
  std::shared_ptr<const StateGrid> grid;
  PlanningScene scene;
  PinholeCamera camera;

  std::size_t shadow_voxels() const { return scene.shadow_centres().size; }
  std::vector<PinholeCamera> views(const CandidateSet& set) const;
};

/// A cell like the thesis' Wall (4.1.1): cubes in a row, one on top, one hidden behind them.
PlannerScene wall_scene(double voxel_size_m, OccluderMode mode);

/// Two pillars of 20 cm, one behind the other.
PlannerScene two_pillars_scene(double voxel_size_m, OccluderMode mode);

/// Two long walls, 7 cm apart, and a cube between them.
PlannerScene corridor_scene(double voxel_size_m, OccluderMode mode);

/// Voxels of the thesis' smallest size: each of the three has some 900 to 4,000 in shadow.
inline constexpr double kThesisVoxel = 0.009375;

/// The views of each position of a set, which follow each other.
std::vector<std::vector<PinholeCamera>> sites(const std::vector<PinholeCamera>& views);

}  // namespace vantage::bench
