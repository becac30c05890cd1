#pragma once

#include <stdexcept>

namespace vantage {

/// Options that are wrong together, as it turns out after they were parsed: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace vantage
