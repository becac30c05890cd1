#include "process/process_setup.hpp"

#include <fcntl.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <string_view>
#include <system_error>

#include "process/printable_text.hpp"

namespace vantage {
namespace {

/// The message itself, for a pattern of spdlog's.
class PrintableMessage : public spdlog::custom_flag_formatter {
 public:
  void format(const spdlog::details::log_msg& message, const std::tm&,
              spdlog::memory_buf_t& to) override {
    const std::string text = printable(shortened({message.payload.data(), message.payload.size()}));
    to.append(text.data(), text.data() + text.size());
  }
  std::unique_ptr<spdlog::custom_flag_formatter> clone() const override {
    return std::make_unique<PrintableMessage>();
  }
};

void set_up_log() {
  const auto logger = spdlog::stderr_color_st("vantage");
  auto formatter = std::make_unique<spdlog::pattern_formatter>();
  formatter->add_flag<PrintableMessage>('*').set_pattern("%^%l:%$ %*");
  logger->set_formatter(std::move(formatter));
  spdlog::set_default_logger(logger);
}

/// Opened the wrong way round, so that using one still fails.
void open_standard_streams() {
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(number, F_GETFD) >= 0 || errno != EBADF) continue;
    (void)::open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY);  // the lowest free one
  }
}

constexpr const char* kThreads =
    "threads: give fewer with --threads, or raise the limit (ulimit -u)";
constexpr const char* kMemory = "memory: use larger voxels, or fewer images";

const char* resource_of(const std::exception& error) noexcept {
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr) return kMemory;
  if (const auto* system = dynamic_cast<const std::system_error*>(&error)) {
    return system->code() == std::errc::resource_unavailable_try_again ? kThreads : nullptr;
  }
  const bool threads =
      std::string_view(error.what()).find("pthread_create") != std::string_view::npos;
  return threads ? kThreads : nullptr;
}

int end_code = 1;  // a terminate handler takes no argument

/// TBB throws from its own threads and from destructors, where no handler of ours is reached.
[[noreturn]] void end_uncaught() {
  const char* resource = nullptr;
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::exception& error) {
    resource = resource_of(error);
  } catch (...) {
  }
  if (resource == nullptr) std::abort();
  for (const char* part : {"error: the system gives no more ", resource, "\n"}) {
    (void)!::write(STDERR_FILENO, part, std::string_view(part).size());
  }
  ::_exit(end_code);
}

}  // namespace

std::string used_up_resource(const std::exception& error) {
  const char* resource = resource_of(error);
  return resource == nullptr ? "" : resource;
}

void set_up_process(int used_up_exit_code) {
  end_code = used_up_exit_code;
  open_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  std::set_terminate(end_uncaught);
  set_up_log();
}

std::vector<std::string> plain_arguments(int argc, char** argv) {
  std::vector<std::string> arguments(argv, argv + argc);
  for (std::string& argument : arguments) {
    const bool number = argument.size() > 2 && argument.starts_with("-.") && argument[2] >= '0' &&
                        argument[2] <= '9';
    if (number) argument.insert(1, "0");
  }
  return arguments;
}

}  // namespace vantage
