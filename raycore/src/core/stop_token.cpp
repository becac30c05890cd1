#include "vantage/raycore/stop_token.hpp"

#include <algorithm>
#include <atomic>

namespace vantage {

struct StopToken::State {
  std::atomic<bool> cancelled{false};
  std::atomic<std::uint64_t> expected{0};
  std::atomic<std::uint64_t> done{0};
  std::atomic<double> reported{0};
  Clock::time_point deadline = Clock::time_point::max();
};

StopToken::StopToken() : state_(std::make_shared<State>()) {}

StopToken StopToken::with_deadline(Clock::time_point deadline) {
  StopToken token;
  token.state_->deadline = deadline;
  return token;
}

void StopToken::cancel() const noexcept {
  state_->cancelled.store(true);
}

StopReason StopToken::reason() const noexcept {
  if (state_->cancelled.load(std::memory_order_relaxed)) return StopReason::cancelled;
  if (state_->deadline == Clock::time_point::max()) return StopReason::none;
  return Clock::now() >= state_->deadline ? StopReason::deadline : StopReason::none;
}

void StopToken::expect(std::uint64_t steps) const noexcept {
  state_->expected += steps;
}

void StopToken::advance(std::uint64_t steps) const noexcept {
  state_->done += steps;
}

double StopToken::progress() const noexcept {
  const double expected = double(state_->expected.load());
  const double now = expected > 0 ? std::min(1.0, double(state_->done.load()) / expected) : 0.0;
  double shown = state_->reported.load();  // more work may turn up: the share never decreases
  while (shown < now && !state_->reported.compare_exchange_weak(shown, now)) {
  }
  return std::max(shown, now);
}

}  // namespace vantage
