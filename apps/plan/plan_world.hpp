#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reconstruct/reconstruct_options.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"
#include "workcell/workcell.hpp"

namespace vantage {

/// Where `vantage plan` takes the objects from.
struct ObjectSource {
  /// "given": the workcell's known_objects; a method of reconstruction; or a world.json. Empty:
  /// given if the workcell has any, else found by multi-view PnP if there is something to find them
  /// by.
  std::string objects;
  ReconstructCommandOptions how = {};  ///< its method is not used
};

/// The world to plan in, and where it came from.
struct PlanWorld {
  WorldModel world;
  std::string objects;                       ///< "given", a method's name, or the file
  std::vector<std::filesystem::path> files;  ///< that were read for it, beside the workcell's
  std::vector<std::string> warnings;  ///< inconsistent images, cameras that could not be located
  Intrinsics first_camera;
};

/// Reads the dataset, and finds the objects and the cameras. A camera that could not be located is
/// left out. Runs in the caller's task arena.
/// @throws Error bad_input as `load_dataset`, `reconstruct_scene` and `read_world` do; for a
/// world.json of other images.
PlanWorld load_plan_world(const std::filesystem::path& dataset, const std::vector<int>& images,
                          const Workcell& workcell, const ObjectSource& source,
                          const StopToken& stop = {});

}  // namespace vantage
