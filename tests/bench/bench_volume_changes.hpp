#pragma once

#include <functional>
#include <string>

namespace vantage::bench {

/// What a row of the table at the end says.
using Report = std::function<void(const std::string& what, const std::string& result)>;

/// Every change that a ShadowVolume follows, with the grid after it, against starting over: both in
/// turns, processor time of one thread.
void add_changes(const Report& report);

}  // namespace vantage::bench
