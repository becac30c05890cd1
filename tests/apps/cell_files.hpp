#pragma once

#include <filesystem>
#include <string>

#include "support/test_data.hpp"

namespace vantage::test {

/// The folder of the shipped workcells.
inline std::filesystem::path shipped_workcells() {
  return assets() / "workcells";
}

inline std::filesystem::path shipped_workcell(const std::string& name) {
  return shipped_workcells() / (name + ".yaml");
}

/// The one line that a workcell needs.
inline const std::string kAreaLine = "work_area: {min_m: [-1, -2, 0], max_m: [1, 2, 0.5]}\n";

}  // namespace vantage::test
