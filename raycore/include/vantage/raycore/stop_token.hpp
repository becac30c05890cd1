#pragma once

#include <chrono>
#include <cstdint>
#include <memory>

#include "vantage/raycore/export.hpp"

namespace vantage {

enum class StopReason { none, cancelled, deadline };

/// Tells long work when to stop, and its owner how far it has progressed.
///
/// Copies share one state. Every method may be called from any thread; `cancel` from a signal
/// handler too. When both happened, `cancelled` wins over `deadline`. Input is validated before the
/// first look at the token: bad input is reported even if the token has already stopped.
class VANTAGE_API StopToken {
 public:
  using Clock = std::chrono::steady_clock;

  /// Never stops unless it is cancelled.
  StopToken();
  static StopToken with_deadline(Clock::time_point deadline);

  void cancel() const noexcept;
  StopReason reason() const noexcept;
  bool stop_requested() const noexcept { return reason() != StopReason::none; }

  /// The worker's side: `steps` of work are to be done, or have been done.
  void expect(std::uint64_t steps) const noexcept;
  void advance(std::uint64_t steps) const noexcept;

  /// The owner's side: the share done, 0 to 1; it never decreases.
  double progress() const noexcept;

 private:
  struct State;
  std::shared_ptr<State> state_;
};

}  // namespace vantage
