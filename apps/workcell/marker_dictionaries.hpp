#pragma once

#include <string>
#include <vector>

#include "workcell/workcell.hpp"

namespace vantage {

/// The dictionaries of the markers on the board and on the types of the knowledge base: of each
/// family the largest, which has the markers of the others.
std::vector<std::string> dictionaries_of(const Workcell& workcell);

/// All that OpenCV has: of each family the largest.
std::vector<std::string> largest_dictionaries();

}  // namespace vantage
