#pragma once

#include <string>

#include "vantage/reconstruction/tracking.hpp"

namespace vantage::reconstruction::detail {

/// "red_cube #3 moved by 0.214 m from (…) to (…) m"; `more` is what else is known of it.
std::string text_of(const TrackEvent& event, const std::string& more);

}  // namespace vantage::reconstruction::detail
