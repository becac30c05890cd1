#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "evaluate/reasoning/reasoning_benchmark.hpp"

namespace vantage {

/// What `vantage evaluate reasoning` was asked for.
struct ReasoningCommandOptions {
  std::filesystem::path workcell, folder;
  std::vector<std::string> methods = {"pnp"};
  int objects = 20;
  std::vector<std::string> types = {};  ///< empty: the workcell's
  std::uint64_t seed = 1;
  nlohmann::json given = nlohmann::json::object();
  bool json = false;
  int threads = 0;

  void add_to(CLI::App& verb);
  ReasoningBenchmarkOptions benchmark() const;
  /// All settings, written out.
  nlohmann::ordered_json config() const;
};

}  // namespace vantage
