#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "evaluate/shadow_filters/shadow_filter_benchmark.hpp"
#include "options/field.hpp"

namespace vantage {

/// What the command line of `vantage evaluate shadow-filters` says.
struct ShadowFilterCommandOptions {
  std::vector<std::string> scenes;
  std::uint64_t seed = 0;
  ShadowFilterOptions settings;
  bool json = false;
  int threads = 0;
  nlohmann::json given = nlohmann::json::object();  ///< fields, until `resolve`

  void add_to(CLI::App& verb);

  /// Puts what was given into the settings.
  /// @throws UsageError for options that do nothing with the others.
  void resolve();

  /// For the result's `config`.
  nlohmann::ordered_json config() const;
};

}  // namespace vantage
