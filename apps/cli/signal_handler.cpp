#include "cli/signal_handler.hpp"

#include <csignal>
#include <utility>

namespace vantage {
namespace {

std::vector<StopToken> watched;  // a signal handler takes no argument

void handle(int signal) {
  std::signal(signal, SIG_DFL);
  for (const StopToken& token : watched) token.cancel();
}

}  // namespace

SignalHandler::SignalHandler(std::vector<StopToken> tokens) {
  watched = std::move(tokens);
  std::signal(SIGINT, handle);
  std::signal(SIGTERM, handle);
}

SignalHandler::~SignalHandler() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  watched.clear();
}

}  // namespace vantage
