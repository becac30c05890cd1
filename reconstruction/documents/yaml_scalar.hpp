#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

namespace vantage {

/// What a plain scalar stands for by YAML 1.2's core schema: null, a bool, a number, or a string.
/// `.Inf` and `.Nan` are numbers however they are capitalised: OpenCV writes `.Nan`.
/// @returns nothing for a number that does not fit a double, or an integer of another base than ten
/// that does not fit 64 bits.
std::optional<nlohmann::json> core_scalar(std::string_view text);

}  // namespace vantage
