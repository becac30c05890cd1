#pragma once

#include "metrics/planning/planning_evaluation.hpp"

namespace vantage::test {

inline MethodRun run_with(const std::string& method, double vox_m3, double true_m3,
                          double run_time_s) {
  const PoseWorth start{1, 0.5 * vox_m3, 0.5 * true_m3}, best{2, vox_m3, true_m3};
  return {method, "m³", Pick{17, Pose(), {{"start", start}, {"aim", best}}, 1}, {run_time_s}};
}

/// Like the thesis' first scene, with round numbers: a voxel of 10 mm is 1 cm³.
inline SceneEvaluation wall_scene() {
  SceneEvaluation scene{.name = "wall:front",
                        .workcell = "wall.yaml",
                        .cameras = {"side"},
                        .voxel_size_m = 0.01,
                        .free_voxels = 8000,
                        .occupied_voxels = 500,
                        .shadow_voxels = 1000,
                        .truly_hidden_m3 = 9e-4,
                        .classify_s = {0.003, 0.001, 0.002}};
  scene.sets.push_back({"full", 34225, 34000, {0.4, 0.6, 0.8}, 9e-4, {}});
  scene.sets.back().runs = {run_with("voxel", 8e-4, 7e-4, 2),
                            run_with("shadowD6", 7.6e-4, 8e-4, 10)};
  scene.sets.push_back({"production", 40, 40, {0.4, 0.8}, 8.5e-4, {}});
  scene.sets.back().runs = {run_with("voxel", 8e-4, 7e-4, 0.01),
                            run_with("shadowD6", 8e-4, 8e-4, 0.05)};
  return scene;
}

/// That, and a scene in which nothing is hidden.
inline PlanningEvaluation two_scenes() {
  SceneEvaluation empty{.name = "foreign_objects:front",
                        .workcell = "foreign_objects.yaml",
                        .cameras = {"front"},
                        .voxel_size_m = 0.01,
                        .free_voxels = 9500,
                        .truly_hidden_m3 = 3e-4,
                        .classify_s = {0.002}};
  for (const char* set : {"full", "production"}) {
    empty.sets.push_back({set, 40, 40, {0.4}, 2e-4, {}});
    empty.sets.back().runs = {{"voxel", "m³", {}, {0.001}}, {"shadowD6", "m^6", {}, {0.001}}};
  }
  return {{"voxel", "shadowD6"}, 5, {wall_scene(), empty}};
}

}  // namespace vantage::test
