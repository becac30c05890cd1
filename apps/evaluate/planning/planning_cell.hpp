#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "simulator/scene/simulated_scene.hpp"
#include "vantage/planner/plan.hpp"
#include "vantage/raycore/world_model.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

/// Which depth images planning gets in addition to the known objects.
enum class DepthKind {
  none,   ///< as the thesis' voxel and shadow methods have it
  ideal,  ///< a sensor that measures every surface exactly
  noisy,  ///< the workcell's stereo camera
};
extern const std::vector<std::string> kDepthKinds;  ///< their names
DepthKind depth_kind_of(const std::string& name);

/// A workcell and what looks at it, as the command line names it: FILE[:CAMERA,...][+DEPTH].
struct PlanningCellName {
  std::filesystem::path workcell;
  std::vector<std::string> cameras{};  ///< empty: all that the workcell has
  std::optional<DepthKind> depth{};
};

/// A name that is a file as a whole is that file.
/// @throws Error bad_input for an unknown kind of depth, and for an empty name.
PlanningCellName planning_cell_name(const std::string& argument);

/// A simulated cell, what planning is told about it, and its ground truth.
struct PlanningCell {
  std::string name;  ///< the workcell's file without its ending, and the cameras, e.g. "wall:front"
  std::string depth;
  WorldModel world;  ///< what the cameras could recognise, at its true pose
  /// The same with depth images, for methods that need them: those of `world`, or if it has none,
  /// the workcell's stereo cameras'.
  WorldModel measured;
  PlanRequest request;
  SimulatedScene scene;
  std::vector<std::filesystem::path> files;  ///< that were read

  std::vector<PinholeCamera> cameras() const;
};

/// The movable camera is a point unless the workcell gives it a body or a clearance.
/// @param usual the depth images of a name that says nothing of them.
/// @param seed of their noise; they are those that `vantage simulate` records with that seed.
/// @throws Error as `load_workcell`, `place_random_objects` and `simulated_cell` do; bad_input for
/// a workcell without cameras, and for a camera that it does not have.
PlanningCell load_planning_cell(const PlanningCellName& name, DepthKind usual, std::uint64_t seed);

}  // namespace vantage
