#include "cli/progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <string>

namespace vantage {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kEnough = 0.02;  // of the work, to tell how long the rest takes

/// "; about 12 s left", once there is enough to tell by.
std::string time_left(double progress, Clock::time_point start) {
  const double elapsed_s = std::chrono::duration<double>(Clock::now() - start).count();
  if (progress < kEnough || elapsed_s < 2) return "";
  const double left_s = elapsed_s * (1 - progress) / progress;
  return left_s < 90 ? fmt::format("; about {:.0f} s left", left_s)
                     : fmt::format("; about {:.0f} min left", left_s / 60);
}

}  // namespace

ProgressLine::ProgressLine(std::string what, const StopToken& token) {
  if (isatty(STDERR_FILENO) == 0) return;
  thread_ = std::jthread([what = std::move(what), token](std::stop_token done) {
    const Clock::time_point start = Clock::now();
    std::mutex mutex;
    std::condition_variable_any wake;
    std::unique_lock lock(mutex);
    while (!wake.wait_for(lock, done, std::chrono::milliseconds(100),
                          [&] { return done.stop_requested(); })) {
      const double progress = token.progress();
      fmt::print(stderr, "\r\033[K{} {:3.0f} %{}", what, 100 * progress,
                 time_left(progress, start));
      std::fflush(stderr);
    }
    fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
  });
}

}  // namespace vantage
