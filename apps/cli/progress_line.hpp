#pragma once

#include <string>
#include <thread>

#include "vantage/raycore/stop_token.hpp"

namespace vantage {

/// Shows a token's progress, and how long the rest will take, on stderr while it lives, if stderr
/// is a terminal.
class ProgressLine {
 public:
  ProgressLine(std::string what, const StopToken& token);

 private:
  std::jthread thread_;  // stops and joins when the line is destroyed
};

}  // namespace vantage
