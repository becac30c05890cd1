#pragma once

#include <doctest/doctest.h>

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "vantage/raycore/error.hpp"

namespace vantage::test {

/// The Error that `action` throws; a failed check, and nothing, if it throws none.
template <class Action>
std::optional<Error> caught(Action&& action) {
  try {
    std::forward<Action>(action)();
  } catch (const Error& error) {
    return error;
  }
  FAIL_CHECK("no error was thrown");
  return std::nullopt;
}

inline void check_parts(const std::string& text, std::initializer_list<std::string_view> parts) {
  CAPTURE(text);
  for (const std::string_view part : parts) {
    CAPTURE(part);
    CHECK(text.find(part) != std::string::npos);
  }
}

/// Checks that `action` throws an Error with this code whose place and message contain these parts.
template <class Action>
void expect_error(ErrorCode code, std::string_view where, std::string_view message,
                  Action&& action) {
  CAPTURE(where);
  CAPTURE(message);
  if (const auto error = caught(std::forward<Action>(action))) {
    CHECK(error->code() == code);
    check_parts(error->where(), {where});
    check_parts(error->message(), {message});
  }
}

template <class Action>
void expect_bad_input(std::string_view where, std::string_view message, Action&& action) {
  expect_error(ErrorCode::bad_input, where, message, std::forward<Action>(action));
}

/// Checks that `action` throws an Error bad_input whose place ends in `where_end` and whose message
/// has every one of `parts`.
template <class Action>
void expect_refused(Action&& action, std::string_view where_end,
                    std::initializer_list<std::string_view> parts) {
  CAPTURE(where_end);
  if (const auto error = caught(std::forward<Action>(action))) {
    CHECK(error->code() == ErrorCode::bad_input);
    CAPTURE(error->where());
    CHECK(error->where().ends_with(where_end));
    check_parts(error->message(), parts);
  }
}

}  // namespace vantage::test
