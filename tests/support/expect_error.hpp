#pragma once

#include <doctest/doctest.h>

#include <string_view>
#include <utility>
#include <vantage/raycore/error.hpp>

namespace vantage::test {

/// Checks that `action` throws an Error with this code whose place and message contain these parts.
template <class Action>
void expect_error(ErrorCode code, std::string_view where, std::string_view message,
                  Action&& action) {
  CAPTURE(where);
  CAPTURE(message);
  try {
    action();
    FAIL_CHECK("no error was thrown");
  } catch (const Error& error) {
    CAPTURE(error.where());
    CAPTURE(error.message());
    CHECK(error.code() == code);
    CHECK(error.where().find(where) != std::string::npos);
    CHECK(error.message().find(message) != std::string::npos);
  }
}

template <class Action>
void expect_bad_input(std::string_view where, std::string_view message, Action&& action) {
  expect_error(ErrorCode::bad_input, where, message, std::forward<Action>(action));
}

}  // namespace vantage::test
