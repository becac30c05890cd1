// world.json, as `plan --objects FILE` reads it.
#include "fuzz_input.hpp"
#include "reconstruct/world_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  static const FileKnowledgeBase knowledge({fuzz::file_with(
      "types.yaml", "object_types:\n  - {name: cube, shape: {box: {size_m: [0.1, 0.1, 0.1]}}}\n")});
  const auto file = fuzz::file_with("world.json", fuzz::text_of(data, size));
  return fuzz::only_errors([&] { (void)read_world(file, knowledge); });
}
