#pragma once

#include <stdexcept>

namespace vantage {

/// Options that do not fit together, found after parsing: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vantage
