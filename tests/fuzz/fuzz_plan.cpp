// plan.json as `evaluate gain` reads it, as far as its schema goes.
#include "documents/json_document.hpp"
#include "documents/schema_check.hpp"
#include "documents/schemas.hpp"
#include "fuzz_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  return fuzz::only_errors(
      [&] { check_schema(parse_json(fuzz::text_of(data, size), "plan.json"), plan_schema()); });
}
