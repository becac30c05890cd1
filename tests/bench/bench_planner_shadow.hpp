#pragma once

#include <string>
#include <utility>
#include <vector>

namespace vantage::bench {

/// What the shadow method costs on the thesis' scenes, and what plain ways to it cost in the same
/// run: lines of a table.
std::vector<std::pair<std::string, std::string>> shadow_report();

}  // namespace vantage::bench
