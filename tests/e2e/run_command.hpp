#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "support/test_data.hpp"

namespace vantage::test {

struct CommandResult {
  int exit_code = -1;
  std::string out;
  std::string err;

  nlohmann::json json() const { return nlohmann::json::parse(out); }
};

/// Runs `vantage ARGUMENTS` through the shell and waits. `prefix` goes before the command, e.g.
/// "timeout -s INT 1".
CommandResult run_vantage(const std::string& arguments, const std::string& prefix = "");

/// The same, with a Ctrl-C some time after the command is ready for it: how long it takes to load
/// depends on what else the machine does.
CommandResult interrupt_vantage(const std::string& arguments, double after_s);

/// A path as an argument of `run_vantage`, with a blank before it.
std::string quoted(const std::filesystem::path& path);

/// A shipped workcell as such an argument, with `rest` after the file's name, e.g. ":front".
std::string quoted_workcell(const std::string& name, const std::string& rest = "");

/// Simulates a shipped workcell, with few samples, into `folder`; fails the test if that fails.
void make_dataset(const std::string& workcell, const std::filesystem::path& folder,
                  const std::string& options = "");

/// A BOP scene with one depth image of a box before a wall, written into `folder`/scene. What is
/// wrong with it is up to the test.
std::filesystem::path write_scene(const TemporaryFolder& folder);

/// The one entry of that scene's scene_camera.json, to change and write back.
nlohmann::json scene_camera();
void write_scene_camera(const std::filesystem::path& scene, const nlohmann::json& entry);

/// A work area that fits that scene.
inline const std::string kSceneArea = " --work-area -0.2 -0.1 0.02 0.2 0.3 0.22 --voxel-size 0.01";

}  // namespace vantage::test
