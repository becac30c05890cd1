#pragma once

#include <filesystem>
#include <string>

#include "workcell.hpp"

namespace vantage {

/// The workcell's file as it is to be read from another folder: paths made to fit, and random
/// objects written out with the poses that they got. What it says is otherwise the same. YAML (in
/// JSON's form, which is YAML too).
/// @param workcell that file, loaded, with `place_random_objects` done.
/// @param folder where the text will be written.
std::string resolved_workcell(const std::filesystem::path& file, const Workcell& workcell,
                              const std::filesystem::path& folder);

}  // namespace vantage
