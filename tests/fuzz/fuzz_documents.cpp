// YAML and JSON. The input's first byte chooses how it is read.
#include "documents/json_document.hpp"
#include "documents/yaml_document.hpp"
#include "fuzz_input.hpp"

namespace {

using namespace vantage;

/// Values can be printed, and every one of them has a place.
void use(const Document& document) {
  if (shown(document.root).empty() || document.place("/a/0") == document.name) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view text = fuzz::text_of(data + 1, size - 1);
  return fuzz::only_errors([&] {
    if (data[0] % 4 == 0) use(parse_json(text, "fuzz"));
    if (data[0] % 4 == 1) use(parse_yaml(text, "fuzz", {.ignore_tags = true}));
    if (data[0] % 4 >= 2) use(parse_yaml(text, "fuzz"));
  });
}
