#pragma once

#include <filesystem>

namespace vantage {

/// Makes a folder for results, with those around it, and clears away what a killed run left there.
/// @throws Error bad_input if it cannot be made, out_of_resources if the disk is full.
void make_output_folder(const std::filesystem::path& folder);

}  // namespace vantage
