#include "metrics/planning/planning_numbers.hpp"

#include <fmt/format.h>

namespace vantage {
namespace {

constexpr double kCm3 = 1e6;

}  // namespace

std::string cm3_text(const std::optional<double>& m3) {
  return m3 ? fmt::format("{:.1f}", *m3 * kCm3) : kNone;
}

std::string thesis_cm3_text(const std::optional<double>& m3) {
  return m3 ? fmt::format("{:.4g}", *m3 * kCm3) : kNone;
}

std::string percent_text(const std::optional<double>& share) {
  return share ? fmt::format("{:.1f} %", 100 * *share) : kNone;
}

std::string time_text(const std::optional<double>& seconds) {
  if (!seconds) return kNone;
  if (*seconds < 0.9995) return fmt::format("{:.3g} ms", 1000 * *seconds);
  return *seconds < 100 ? fmt::format("{:.3g} s", *seconds) : fmt::format("{:.1f} s", *seconds);
}

std::string count_text(std::size_t count) {
  const std::string digits = std::to_string(count);
  std::string text;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && (digits.size() - i) % 3 == 0) text += ',';
    text += digits[i];
  }
  return text;
}

std::string score_text(double score) {
  return fmt::format("{:.3g}", score);
}

std::string times_text(double factor) {
  return fmt::format("×{:.3g}", factor);
}

}  // namespace vantage
