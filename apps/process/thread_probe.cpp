#include "process/thread_probe.hpp"

#include <fmt/format.h>
#include <pthread.h>

#include <cstddef>
#include <latch>
#include <system_error>
#include <vector>

#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr std::size_t kStackBytes = std::size_t(4) << 20;  // as TBB's threads have

/// Threads that wait for each other, joined with their owner.
class WaitingThreads {
 public:
  WaitingThreads() {
    pthread_attr_init(&attributes_);
    pthread_attr_setstacksize(&attributes_, kStackBytes);
  }
  ~WaitingThreads() {
    end_.count_down();
    for (const pthread_t thread : threads_) pthread_join(thread, nullptr);
    pthread_attr_destroy(&attributes_);
  }
  WaitingThreads(const WaitingThreads&) = delete;
  WaitingThreads& operator=(const WaitingThreads&) = delete;

  /// @returns an error number; 0 for none.
  int add() {
    pthread_t thread = {};
    const auto wait = [](void* latch) -> void* {
      static_cast<std::latch*>(latch)->wait();
      return nullptr;
    };
    threads_.reserve(threads_.size() + 1);
    const int error = pthread_create(&thread, &attributes_, wait, &end_);
    if (error == 0) threads_.push_back(thread);
    return error;
  }

 private:
  std::latch end_{1};
  pthread_attr_t attributes_ = {};
  std::vector<pthread_t> threads_;
};

}  // namespace

void check_threads_start(int count) {
  WaitingThreads threads;
  for (int i = 0; i < count; ++i) {
    const int error = threads.add();
    if (error == 0) continue;
    throw Error(ErrorCode::out_of_resources, "--threads",
                fmt::format("thread {} of {} cannot be started: {}; give fewer, or raise the limit "
                            "of processes (ulimit -u) or memory",
                            i + 1, count, std::generic_category().message(error)));
  }
}

}  // namespace vantage
