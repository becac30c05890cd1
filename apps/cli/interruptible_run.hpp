#pragma once

#include <string>
#include <utility>

#include "cli/exit_code.hpp"
#include "cli/progress_line.hpp"
#include "cli/signal_handler.hpp"
#include "cli/workers.hpp"

namespace vantage {

/// One run of a command: its worker threads, a Ctrl-C that cancels it, and its progress.
class InterruptibleRun {
 public:
  /// @param threads 0: one for each core.
  /// @throws Error out_of_resources if they cannot be started.
  explicit InterruptibleRun(int threads) : handler_({stop_}), workers_(threads) {}

  /// Does the work with the threads, and shows its progress as `what`, e.g. "evaluating".
  template <class Work>
  auto execute(const std::string& what, Work&& work) {
    return workers_.execute([&] {
      const ProgressLine progress(what, stop_);
      return std::forward<Work>(work)();
    });
  }
  /// The same without progress.
  template <class Work>
  auto execute(Work&& work) {
    return workers_.execute(std::forward<Work>(work));
  }

  const StopToken& stop() const { return stop_; }
  bool cancelled() const { return stop_.stop_requested(); }
  ExitCode exit_code() const { return cancelled() ? ExitCode::cancelled : ExitCode::ok; }

 private:
  StopToken stop_;
  SignalHandler handler_;
  Workers workers_;
};

}  // namespace vantage
