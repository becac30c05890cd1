#pragma once

#include <vector>

#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// While it lives, the first Ctrl-C (or SIGTERM) cancels the tokens; a second one ends the process
/// as usual. One at a time.
class Interrupt {
 public:
  explicit Interrupt(std::vector<StopToken> tokens);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;
};

}  // namespace vantage
