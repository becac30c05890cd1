#include "vantage/raycore/error.hpp"

#include <utility>

namespace vantage {

Error::Error(ErrorCode code, std::string where, std::string message)
    : std::runtime_error(where.empty() ? message : where + ": " + message),
      code_(code),
      where_(std::move(where)),
      message_(std::move(message)) {}

Error bad_input(std::string where, std::string message) {
  return {ErrorCode::bad_input, std::move(where), std::move(message)};
}

}  // namespace vantage
