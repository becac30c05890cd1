#include "cli/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>

namespace vantage {

ProgressLine::ProgressLine(std::string what, const StopToken& token) {
  if (isatty(STDERR_FILENO) == 0) return;
  thread_ = std::jthread([what = std::move(what), token](std::stop_token done) {
    std::mutex mutex;
    std::condition_variable_any wake;
    std::unique_lock lock(mutex);
    while (!wake.wait_for(lock, done, std::chrono::milliseconds(100),
                          [&] { return done.stop_requested(); })) {
      fmt::print(stderr, "\r{} {:3.0f} %", what, 100 * token.progress());
      std::fflush(stderr);
    }
    fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
  });
}

}  // namespace vantage
