#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "evaluate/tracking/tracking_benchmark.hpp"
#include "options/field.hpp"

namespace vantage {

/// The numbers of a benchmark. The description points into what it describes.
FieldGroup fields_of(TrackingBenchmarkOptions& options);

/// What `vantage evaluate tracking` was asked for.
struct TrackingCommandOptions {
  std::filesystem::path workcell, folder;
  std::vector<std::string> filters = {"none", "features", "kalman"};
  int objects = 12;
  std::vector<std::string> types = {};  ///< empty: the workcell's
  std::uint64_t seed = 1;
  bool no_arm = false;
  nlohmann::json given = nlohmann::json::object();
  bool json = false;
  int threads = 0;

  void add_to(CLI::App& verb);
  TrackingBenchmarkOptions benchmark() const;
  std::vector<TemporalFilter> chosen_filters() const;
};

}  // namespace vantage
