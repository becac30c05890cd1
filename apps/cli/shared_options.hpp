#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

namespace vantage {

// Options that most verbs have, each defined once.

/// --threads; 0, the default, is one for each core.
void add_threads_option(CLI::App& verb, int& threads);

/// -o/--output.
/// @param content what the folder is for, e.g. "world.json and pictures".
CLI::Option* add_output_option(CLI::App& verb, std::filesystem::path& folder,
                               const std::string& content);

/// --json.
/// @param file the document that goes to stdout, e.g. "world.json".
void add_json_flag(CLI::App& verb, bool& json, const std::string& file);

/// --images of a dataset.
void add_images_option(CLI::App& verb, std::vector<int>& images);

}  // namespace vantage
