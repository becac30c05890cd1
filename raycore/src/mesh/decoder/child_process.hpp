#pragma once

#include <sys/types.h>
#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>

namespace vantage::raycore::detail {

/// What a child process may use.
struct ChildLimits {
  unsigned computing_s = 0;        ///< CPU time
  unsigned waiting_s = 0;          ///< wall-clock time, as another program may have the CPU
  std::uint64_t memory_bytes = 0;  ///< more than what this process has mapped
};

/// A function that runs in a process of its own, a fork of this one, so that its faults stay there:
/// it has nothing but a pipe to this process, cannot write files, has the limits above, and ends
/// when the thread that started it does. One owner, one thread.
class ChildProcess {
 public:
  /// `work` gets the pipe's end to write to. Its process ends when it returns; it must not throw.
  /// @throws Error out_of_resources, at `where`, if no process can be started.
  ChildProcess(const ChildLimits& limits, const std::string& where,
               const std::function<void(int pipe)>& work);
  ~ChildProcess();  ///< ends the process if it still runs
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Waits for the next bytes until `bytes` is full, the process ends, or its time is up.
  /// @returns how many came.
  std::size_t read(std::span<std::uint8_t> bytes);

  /// Ends it, and says how it ended: "crashed (signal 11)", "took more than 3 s of computing", …;
  /// empty if it returned from `work`.
  std::string end();

  /// Whether memory ran out; after `end`.
  bool out_of_memory() const { return out_of_memory_; }

 private:
  ChildLimits limits_;
  std::chrono::steady_clock::time_point deadline_;
  pid_t process_ = -1;
  int pipe_ = -1;
  bool late_ = false, out_of_memory_ = false;
};

/// Writes all of it to a pipe. False if the other end is closed.
bool write_to_pipe(int pipe, std::span<const std::uint8_t> bytes);

}  // namespace vantage::raycore::detail
