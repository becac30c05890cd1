#pragma once

#include <vector>

#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// While it lives, the first Ctrl-C (or SIGTERM) cancels the tokens; a second one ends the process
/// as usual. One at a time.
class SignalHandler {
 public:
  explicit SignalHandler(std::vector<StopToken> tokens);
  ~SignalHandler();
  SignalHandler(const SignalHandler&) = delete;
  SignalHandler& operator=(const SignalHandler&) = delete;
};

}  // namespace vantage
