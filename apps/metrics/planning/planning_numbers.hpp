#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace vantage {

// Numbers as the report of an evaluation of planning prints them; a missing value is a dash.

inline constexpr const char* kNone = "–";

/// Of cubic metres: cubic centimetres, e.g. "943.1".
std::string cm3_text(const std::optional<double>& m3);

/// As few digits as the thesis prints: "943", "2271".
std::string thesis_cm3_text(const std::optional<double>& m3);

/// "98.5 %"
std::string percent_text(const std::optional<double>& share);

/// "2.1 s", "12 ms"
std::string time_text(const std::optional<double>& seconds);

/// "34,225"
std::string count_text(std::size_t count);

/// Three significant digits.
std::string score_text(double score);

/// "×123"
std::string times_text(double factor);

}  // namespace vantage
