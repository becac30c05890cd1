#pragma once

#include "vantage/raycore/error.hpp"
#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// What the process returns.
enum class ExitCode {
  ok = 0,
  failure = 1,  ///< a bug of ours: nothing that the user can fix
  usage = 2,
  bad_input = 3,
  no_feasible_view = 4,
  deadline = 5,  ///< the partial result was written
  out_of_resources = 6,
  cancelled = 130,
};

inline ExitCode exit_code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::bad_input:
      return ExitCode::bad_input;
    case ErrorCode::no_feasible_view:
      return ExitCode::no_feasible_view;
    case ErrorCode::out_of_resources:
      return ExitCode::out_of_resources;
    case ErrorCode::cancelled:
      return ExitCode::cancelled;
  }
  return ExitCode::failure;
}

}  // namespace vantage
