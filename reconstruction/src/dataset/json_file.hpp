#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "documents/json_document.hpp"

namespace vantage::reconstruction::detail {

/// The values of a JSON file, for those who make their own places; `read_json` says what it throws.
inline nlohmann::json parse_json_file(const std::filesystem::path& path,
                                      const StopToken& stop = {}) {
  return read_json(path, kJsonLimits, stop).root;
}

}  // namespace vantage::reconstruction::detail
