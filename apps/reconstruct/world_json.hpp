#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "reconstruct/scene_reconstruction.hpp"

namespace vantage {

/// What goes into world.json beside the world.
struct WorldRecord {
  std::vector<std::filesystem::path> inputs;
  nlohmann::ordered_json config;
  std::vector<std::string> warnings = {};
  double load_s = 0;
  double total_s = 0;
};

/// world.json, as assets/schema/world.schema.json describes it. `obj_id` counts a type's place in
/// the knowledge base from 1, as `vantage simulate` numbers its models; a BOP type has its own.
/// @param objects `known_objects(reconstruction.result)`: their names.
nlohmann::ordered_json world_to_json(const BopScene& scene, const Workcell& workcell,
                                     const SceneReconstruction& reconstruction,
                                     const std::vector<KnownObject>& objects,
                                     const WorldRecord& record);

/// A summary: cameras, objects, and unexplained features.
std::string summary_of_world(const nlohmann::ordered_json& world);

}  // namespace vantage
