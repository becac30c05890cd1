#include "cli/number_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace vantage {
namespace {

/// NaN for text that is not a number.
double number_of(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const bool whole = !text.empty() && end == text.c_str() + text.size();
  return whole ? number : std::numeric_limits<double>::quiet_NaN();
}

/// `name` stands in the help after the option's type.
template <class Good>
CLI::Validator check(const Good& good, const std::string& name, const std::string& expected) {
  return {[good, expected](const std::string& text) -> std::string {
            if (good(number_of(text))) return {};
            return fmt::format("found '{}'; expected {}", text, expected);
          },
          name};
}

}  // namespace

CLI::Validator positive_number() {
  return check([](double x) { return std::isfinite(x) && x > 0; }, "POSITIVE",
               "a finite number above 0");
}

CLI::Validator number_from_zero() {
  return check([](double x) { return std::isfinite(x) && x >= 0; }, "NONNEGATIVE",
               "a finite number, 0 or above");
}

CLI::Validator number_between(double low, double high) {
  return check([low, high](double x) { return x >= low && x <= high; },
               fmt::format("[{:g} - {:g}]", low, high),
               fmt::format("a number from {:g} to {:g}", low, high));
}

}  // namespace vantage
