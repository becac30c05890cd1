#include "mesh/decoder/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <new>
#include <system_error>
#include <utility>

#include "vantage/raycore/error.hpp"

// The sanitizers map terabytes of addresses: a limit of them would end their programs at once.
#ifndef VANTAGE_SANITIZED
#define VANTAGE_SANITIZED 0
#endif

namespace vantage::raycore::detail {
namespace {

constexpr int kOutOfMemory = 77;  // the exit code of a child without memory

/// Bytes of addresses that this process has mapped; 0 if that is not known.
std::uint64_t mapped_bytes() {
  unsigned long long pages = 0;
  if (std::FILE* file = std::fopen("/proc/self/statm", "re")) {
    if (std::fscanf(file, "%llu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * std::uint64_t(::sysconf(_SC_PAGESIZE));
}

void limit(int resource, std::uint64_t soft, std::uint64_t hard) {
  // A limit that is there may be lower already.
  rlimit now = {};
  if (::getrlimit(static_cast<__rlimit_resource_t>(resource), &now) != 0) return;
  const rlimit next = {std::min<rlim_t>(soft, now.rlim_max), std::min<rlim_t>(hard, now.rlim_max)};
  ::setrlimit(static_cast<__rlimit_resource_t>(resource), &next);
}

/// Signals do here what they do in a fresh process, whatever handlers the host program has.
void reset_signals() {
  for (int number = 1; number < NSIG; ++number) std::signal(number, SIG_DFL);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// Leaves nothing open but the pipe; what decoders print goes nowhere.
int close_all_but(int pipe) {
  const int null = ::open("/dev/null", O_RDWR);
  for (int file = 0; file < 3 && null >= 0; ++file) ::dup2(null, file);
  ::dup2(pipe, 3);
#ifdef SYS_close_range
  ::syscall(SYS_close_range, 4U, ~0U, 0U);
#endif
  return 3;
}

/// In the child. Nothing here takes a lock that another thread of the parent could have held.
[[noreturn]] void run_child(int pipe, const ChildLimits& limits, std::uint64_t mapped, pid_t parent,
                            const std::function<void(int)>& work) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it ended before
  reset_signals();
  const int output = close_all_but(pipe);
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_FSIZE, 0, 0);
  limit(RLIMIT_CPU, limits.computing_s, limits.computing_s + 1);
  if (!VANTAGE_SANITIZED && mapped > 0) {
    limit(RLIMIT_AS, mapped + limits.memory_bytes, mapped + limits.memory_bytes);
  }
  std::set_new_handler([] { ::_exit(kOutOfMemory); });
  work(output);
  ::_exit(0);
}

}  // namespace

ChildProcess::ChildProcess(const ChildLimits& limits, const std::string& where,
                           const std::function<void(int)>& work)
    : limits_(limits),
      deadline_(std::chrono::steady_clock::now() + std::chrono::seconds(limits.waiting_s)) {
  const auto fail = [&](int code) {
    throw Error(ErrorCode::out_of_resources, where,
                fmt::format("cannot start a process to read it: {}",
                            std::generic_category().message(code)));
  };
  std::array<int, 2> ends = {};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail(errno);
  const std::uint64_t mapped = mapped_bytes();
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ == 0) run_child(ends[1], limits, mapped, parent, work);
  const int code = errno;
  ::close(ends[1]);
  pipe_ = ends[0];
  if (process_ > 0) return;
  ::close(pipe_);
  fail(code);
}

ChildProcess::~ChildProcess() {
  end();
}

std::size_t ChildProcess::read(std::span<std::uint8_t> bytes) {
  std::size_t done = 0;
  while (done < bytes.size() && pipe_ >= 0) {
    const auto left =
        std::chrono::ceil<std::chrono::milliseconds>(deadline_ - std::chrono::steady_clock::now());
    pollfd waiting = {pipe_, POLLIN, 0};
    const int ready = left.count() > 0 ? ::poll(&waiting, 1, int(left.count())) : 0;
    if (ready < 0 && errno == EINTR) continue;
    if (ready == 0) late_ = true;
    if (ready <= 0) break;
    const ssize_t count = ::read(pipe_, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    done += std::size_t(count);
  }
  return done;
}

std::string ChildProcess::end() {
  if (process_ <= 0) return {};
  ::close(std::exchange(pipe_, -1));  // a child that still writes gets a signal
  if (late_) ::kill(process_, SIGKILL);
  int status = 0;
  pid_t ended = 0;
  while ((ended = ::waitpid(process_, &status, 0)) < 0 && errno == EINTR) {
  }
  process_ = -1;
  if (late_) return fmt::format("took more than {} s", limits_.waiting_s);
  if (ended < 0) return {};  // the host program reaps all children, so nothing is known
  if (WIFSIGNALED(status) && (WTERMSIG(status) == SIGXCPU || WTERMSIG(status) == SIGKILL)) {
    return fmt::format("took more than {} s of computing", limits_.computing_s);
  }
  if (WIFSIGNALED(status)) return fmt::format("crashed (signal {})", WTERMSIG(status));
  out_of_memory_ = WEXITSTATUS(status) == kOutOfMemory;
  if (out_of_memory_) {
    return fmt::format("needed more than {} MiB of memory", limits_.memory_bytes >> 20);
  }
  return WEXITSTATUS(status) == 0 ? "" : fmt::format("failed (exit code {})", WEXITSTATUS(status));
}

bool write_to_pipe(int pipe, std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(pipe, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes = bytes.subspan(std::size_t(count));
  }
  return true;
}

}  // namespace vantage::raycore::detail
