#pragma once

#include <CLI/CLI.hpp>

namespace vantage {

// Checks of options' values. Unlike CLI11's own, they refuse "nan", which lies in any range, and
// say what they expect without the digits of the largest double.

/// A finite number above 0.
CLI::Validator positive_number();

/// A finite number, 0 or above.
CLI::Validator number_from_zero();

/// A number from `low` to `high`, both included.
CLI::Validator number_between(double low, double high);

}  // namespace vantage
