#pragma once

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>

#include <cstddef>
#include <utility>

namespace vantage {

/// The threads that a command works with: as many as its user said, or as the machine has.
class Workers {
 public:
  /// @param threads 0: all that the machine has.
  explicit Workers(int threads)
      : count_(threads > 0 ? threads : tbb::info::default_concurrency()),
        allow_(tbb::global_control::max_allowed_parallelism, std::size_t(count_)),
        arena_(count_) {}

  template <class Work>
  auto execute(Work&& work) {
    return arena_.execute(std::forward<Work>(work));
  }

 private:
  int count_;
  tbb::global_control allow_;  // more than the machine has, too
  tbb::task_arena arena_;
};

}  // namespace vantage
