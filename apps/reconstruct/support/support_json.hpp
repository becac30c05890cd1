#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "vantage/reconstruction/support.hpp"

namespace vantage {

/// As JSON has it, e.g. "stands".
std::string verdict_name(SupportVerdict verdict);

/// What holds an object, as `stability` in world.json.
/// @param objects, structures that `support` counts.
nlohmann::ordered_json to_json(const ObjectSupport& support, std::span<const KnownObject> objects,
                               std::span<const KnownObject> structures);

}  // namespace vantage
