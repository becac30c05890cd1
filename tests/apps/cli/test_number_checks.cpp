#include "cli/number_checks.hpp"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace vantage::test {
namespace {

bool accepts(const CLI::Validator& check, std::string text) {
  return check(text).empty();
}

}  // namespace

TEST_CASE("numbers of options are finite and within their limits") {
  for (const char* text : {"nan", "inf", "-inf", "abc", "", "1x", "-0.001", "-1"}) {
    CAPTURE(text);
    CHECK_FALSE(accepts(positive_number(), text));
    CHECK_FALSE(accepts(number_from_zero(), text));
    CHECK_FALSE(accepts(number_between(0, 16), text));
  }
  CHECK_FALSE(accepts(positive_number(), "0"));
  CHECK_FALSE(accepts(number_between(0, 16), "16.001"));
  CHECK(accepts(positive_number(), "1e-9"));
  CHECK(accepts(number_from_zero(), "0"));
  CHECK(accepts(number_between(0, 16), "0"));
  CHECK(accepts(number_between(0, 16), "16"));
}

TEST_CASE("a refused number is shown with what was expected instead") {
  CLI::App app;
  std::vector<double> radii_m;
  app.add_option("--radii", radii_m)->delimiter(',')->check(positive_number());
  std::string message;
  try {
    app.parse("--radii 0.5,-2");
  } catch (const CLI::ParseError& error) {
    message = error.what();
  }
  CHECK(message == "--radii: found '-2'; expected a finite number above 0");
  CHECK(number_between(0, 1e9).get_description() == "[0 - 1e+09]");
}

}  // namespace vantage::test
