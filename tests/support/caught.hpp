#pragma once

#include <doctest/doctest.h>

#include <initializer_list>
#include <string>
#include <string_view>

#include "vantage/raycore/error.hpp"

namespace vantage::test {

/// Fails the test unless `function` throws an Error bad_input whose place ends in `where_end` and
/// whose message has every one of `parts`.
template <class Function>
void expect_refused(Function&& function, std::string_view where_end,
                    std::initializer_list<std::string_view> parts) {
  try {
    function();
  } catch (const Error& error) {
    CHECK(error.code() == ErrorCode::bad_input);
    CAPTURE(error.where());
    CHECK(error.where().ends_with(where_end));
    CAPTURE(error.message());
    for (const std::string_view part : parts) {
      CAPTURE(part);
      CHECK(error.message().find(part) != std::string::npos);
    }
    return;
  }
  FAIL_CHECK("nothing was refused; expected an error at " << std::string(where_end));
}

}  // namespace vantage::test
