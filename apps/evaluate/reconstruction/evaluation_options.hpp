#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "evaluate/reconstruction/reconstruction_evaluation.hpp"
#include "reconstruct/reconstruct_options.hpp"

namespace vantage {

/// What the command line of `vantage evaluate reconstruction` says.
struct EvaluationCommandOptions {
  std::filesystem::path dataset, workcell, folder;
  std::vector<int> images;
  std::vector<std::string> methods = kReconstructionMethods;
  std::string sizes = "2-";  ///< numbers of cameras in a subset
  ReconstructCommandOptions how;
  ReconstructionEvaluationOptions settings;
  bool json = false;
  int threads = 0;
  nlohmann::json given = nlohmann::json::object();  ///< fields, until `resolve`

  void add_to(CLI::App& verb);

  /// Puts what was given into the settings.
  /// @throws UsageError for options that do nothing without others; Error bad_input for sizes that
  /// are no numbers of cameras.
  void resolve();

  /// For the result's `config`.
  nlohmann::ordered_json config() const;
};

}  // namespace vantage
