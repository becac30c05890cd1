#pragma once

#include <stdexcept>
#include <string>

#include "vantage/raycore/export.hpp"

namespace vantage {

enum class ErrorCode {
  bad_input,         ///< a file, a key or an argument is not what it has to be
  no_feasible_view,  ///< every candidate view was rejected
  out_of_resources,  ///< memory or disk space is used up, or a stated limit is exceeded
  cancelled,         ///< the StopToken was, before there was a result
};

/// What vantage throws. `what()` reads "where: message".
///
/// `where` is the place that the user can go to (file, line, key, argument); `message` has the
/// value found, what was expected, and what to do.
class VANTAGE_API Error : public std::runtime_error {
 public:
  Error(ErrorCode code, std::string where, std::string message);

  ErrorCode code() const noexcept { return code_; }
  const std::string& where() const noexcept { return where_; }
  const std::string& message() const noexcept { return message_; }

 private:
  ErrorCode code_;
  std::string where_;
  std::string message_;
};

/// An Error with `ErrorCode::bad_input`.
VANTAGE_API Error bad_input(std::string where, std::string message);

}  // namespace vantage
