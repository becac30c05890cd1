#include "options/field.hpp"

#include <fmt/format.h>

#include <cmath>

namespace vantage {

std::string ValidRange::text(bool integer) const {
  const char* number = integer ? "an integer" : "a number";
  if (std::isfinite(min) && std::isfinite(max)) {
    return fmt::format("{} {} {:g} {} {:g}", number, without_min ? "above" : "from", min,
                       without_min ? "and at most" : "to", max);
  }
  if (std::isfinite(min)) {
    return without_min ? fmt::format("{} above {:g}", number, min)
                       : fmt::format("{}, {:g} or above", number, min);
  }
  return std::isfinite(max) ? fmt::format("{} of at most {:g}", number, max) : number;
}

}  // namespace vantage
