#include "vantage/raycore/stop_token.hpp"

#include <doctest/doctest.h>

#include <atomic>
#include <thread>

using namespace vantage;
using Clock = StopToken::Clock;
using namespace std::chrono_literals;

TEST_CASE("a token stops only when it is cancelled or its deadline is reached") {
  const StopToken token;
  CHECK(token.reason() == StopReason::none);
  CHECK_FALSE(token.stop_requested());
  token.cancel();
  CHECK(token.reason() == StopReason::cancelled);
  CHECK(token.stop_requested());
}

TEST_CASE("a deadline stops, a later one does not yet") {
  CHECK(StopToken::with_deadline(Clock::now() + 1h).reason() == StopReason::none);
  CHECK(StopToken::with_deadline(Clock::now() - 1ms).reason() == StopReason::deadline);
  CHECK(StopToken::with_deadline(Clock::time_point::max()).reason() == StopReason::none);
}

TEST_CASE("cancel wins over the deadline") {
  const StopToken token = StopToken::with_deadline(Clock::now() - 1s);
  CHECK(token.reason() == StopReason::deadline);
  token.cancel();
  CHECK(token.reason() == StopReason::cancelled);
}

TEST_CASE("copies share one state") {
  const StopToken token;
  const StopToken copy = token;
  const StopToken other;
  copy.expect(10);
  copy.advance(5);
  CHECK(token.progress() == 0.5);
  copy.cancel();
  CHECK(token.stop_requested());
  CHECK_FALSE(other.stop_requested());
  CHECK(other.progress() == 0);
}

TEST_CASE("progress never goes back, not even when more work turns up") {
  const StopToken token;
  CHECK(token.progress() == 0);
  token.expect(4);
  CHECK(token.progress() == 0);
  token.advance(2);
  CHECK(token.progress() == 0.5);
  token.expect(96);
  CHECK(token.progress() == 0.5);
  token.advance(58);
  CHECK(token.progress() == doctest::Approx(0.6));
  token.advance(1000);
  CHECK(token.progress() == 1);
}

TEST_CASE("progress is monotone while other threads work") {
  const StopToken token;
  constexpr int kSteps = 20000;
  std::atomic<bool> backwards{false};
  token.expect(1000);
  std::thread worker([&] {
    for (int i = 0; i < kSteps; ++i) token.advance(1), token.expect(i % 2);
  });
  const auto watch = [&] {
    for (double last = 0; token.progress() < 1 && !token.stop_requested();) {
      const double now = token.progress();
      if (now < last) backwards = true;
      last = now;
    }
  };
  std::thread first(watch), second(watch);
  worker.join();
  token.cancel();
  first.join();
  second.join();
  CHECK_FALSE(backwards);
  CHECK(token.progress() == 1);
}
