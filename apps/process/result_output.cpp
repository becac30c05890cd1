#include "process/result_output.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>

#include "process/printable_text.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

void write_to_stdout(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(STDOUT_FILENO, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      throw Error(
          ErrorCode::out_of_resources, "stdout",
          fmt::format("the result cannot be written there: {}; the output files were written",
                      std::generic_category().message(errno)));
    }
    text.remove_prefix(std::size_t(count));
  }
}

}  // namespace

void print_text(const std::string& text) {
  write_to_stdout(printable(text));
}

void print_result(bool as_json, const nlohmann::ordered_json& json,
                  const std::function<std::string()>& summary) {
  if (as_json) {
    write_to_stdout(json_text(json));
  } else {
    print_text(summary());
  }
}

std::optional<Error> try_print_result(bool as_json, const nlohmann::ordered_json& json,
                                      const std::function<std::string()>& summary) {
  try {
    print_result(as_json, json, summary);
  } catch (const Error& error) {
    return error;
  }
  return std::nullopt;
}

}  // namespace vantage
