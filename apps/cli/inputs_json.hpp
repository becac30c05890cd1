#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

namespace vantage {

/// Which files a result was made of: their paths as they were opened, and their hashes. Each once,
/// in the order of their first place.
/// @throws Error bad_input for a file that cannot be read.
nlohmann::ordered_json inputs_json(const std::vector<std::filesystem::path>& files);

}  // namespace vantage
