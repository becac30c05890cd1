#include <doctest/doctest.h>

#include <vantage/raycore/error.hpp>

using namespace vantage;

TEST_CASE("an error reads as place and message") {
  const Error error(ErrorCode::out_of_resources, "plan.json", "the disk is full");
  CHECK(error.code() == ErrorCode::out_of_resources);
  CHECK(error.where() == "plan.json");
  CHECK(error.message() == "the disk is full");
  CHECK(std::string(error.what()) == "plan.json: the disk is full");
}

TEST_CASE("an error without a place is its message alone") {
  CHECK(std::string(bad_input("", "no input").what()) == "no input");
  CHECK(bad_input("", "no input").code() == ErrorCode::bad_input);
}
