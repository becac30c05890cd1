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

/// While it lives, the first Ctrl-C ends the process at once, with exit code 130: files are being
/// read, so that there is no result yet that could be saved, and no reader has to ask, however long
/// one file takes. Without a SignalHandler it does nothing. They may be nested.
class ReadingPhase {
 public:
  /// @throws Error cancelled if the signal came before.
  ReadingPhase();
  ~ReadingPhase();
  ReadingPhase(const ReadingPhase&) = delete;
  ReadingPhase& operator=(const ReadingPhase&) = delete;
};

}  // namespace vantage
