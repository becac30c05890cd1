#pragma once

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <utility>

#include "process/thread_probe.hpp"

namespace vantage {

/// The threads that a command works with: as many as its user asked for, or one per core.
class Workers {
 public:
  /// @param threads 0: one per core.
  /// @throws Error out_of_resources if they cannot be started.
  explicit Workers(int threads)
      : count_(startable(threads > 0 ? threads : tbb::info::default_concurrency())),
        allow_(tbb::global_control::max_allowed_parallelism, std::size_t(count_)),
        arena_(count_) {}

  template <class Work>
  auto execute(Work&& work) {
    return arena_.execute(std::forward<Work>(work));
  }

 private:
  /// The caller's own thread works, too.
  static int startable(int count) { return check_threads_start(count - 1), count; }

  int count_;
  tbb::global_control allow_;  // also more than there are cores
  tbb::task_arena arena_;
};

}  // namespace vantage
