#include "cli/signal_handler.hpp"

#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>
#include <utility>

#include "cli/exit_code.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

std::vector<StopToken> watched;  // a signal handler takes no argument
std::atomic<int> reading_phases{0};
std::atomic<bool> signalled{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

/// Does only what a signal handler may do.
[[noreturn]] void end_process() {
  constexpr std::string_view kText = "error: interrupted while files were read; nothing written\n";
  [[maybe_unused]] const ssize_t ignored = ::write(STDERR_FILENO, kText.data(), kText.size());
  ::_exit(int(ExitCode::cancelled));
}

void handle(int signal) {
  std::signal(signal, SIG_DFL);
  signalled = true;
  if (reading_phases > 0) end_process();
  for (const StopToken& token : watched) token.cancel();
}

}  // namespace

SignalHandler::SignalHandler(std::vector<StopToken> tokens) {
  watched = std::move(tokens);
  signalled = false;
  std::signal(SIGINT, handle);
  std::signal(SIGTERM, handle);
}

SignalHandler::~SignalHandler() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  watched.clear();
  signalled = false;
}

ReadingPhase::ReadingPhase() {
  ++reading_phases;
  if (!signalled) return;
  --reading_phases;
  throw Error(ErrorCode::cancelled, "reading files", "interrupted; nothing written");
}

ReadingPhase::~ReadingPhase() {
  --reading_phases;
}

}  // namespace vantage
