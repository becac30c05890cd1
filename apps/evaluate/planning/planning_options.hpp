#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "evaluate/planning/planning_benchmark.hpp"

namespace vantage {

/// What `vantage evaluate planning` is given.
struct PlanningCommandOptions {
  std::vector<std::string> scenes;
  std::filesystem::path folder;
  std::vector<std::string> methods{"voxel", "shadowD0", "shadowD3", "shadowD6",
                                   "mesh",  "meshD6",   "light"};
  std::vector<std::string> sets{"full", "production"};
  std::string value = "bound";
  std::string depth = "none";
  std::uint64_t seed = 0;
  PlanningBenchmarkOptions benchmark;
  nlohmann::json given = nlohmann::json::object();  ///< fields of the volume, servo and polish
  bool no_pictures = false, json = false;
  int threads = 0;

  void add_to(CLI::App& verb);
};

}  // namespace vantage
