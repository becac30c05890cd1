// A knowledge base, with the meshes that it names missing.
#include "fuzz_input.hpp"
#include "vantage/reconstruction/knowledge_base.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  const auto file = fuzz::file_with("types.yaml", fuzz::text_of(data, size));
  return fuzz::only_errors([&] { (void)FileKnowledgeBase({file}); });
}
