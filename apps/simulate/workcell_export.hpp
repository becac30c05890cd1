#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "workcell/workcell.hpp"

namespace vantage {

/// Writes a workcell into a folder so that it stands on its own there and can be moved with it:
/// `folder`/workcell.yaml, and `folder`/cell/ with copies of the files that it names. Random
/// objects are written out with the poses that they got; what it says is otherwise the same.
/// (JSON's form, which is YAML too.)
/// @param file the workcell's file.
/// @param workcell that file, loaded, with `place_random_objects` done.
/// @param calibrations of the recording's cameras, in `folder`: one, one for each, or none at all.
/// @throws Error as `read_yaml` and `write_file` do.
void write_cell_bundle(const std::filesystem::path& file, const Workcell& workcell,
                       const std::vector<std::string>& calibrations,
                       const std::filesystem::path& folder);

}  // namespace vantage
