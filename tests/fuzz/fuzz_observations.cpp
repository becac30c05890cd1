// Observations of other detectors, as JSON lines.
#include "fuzz_input.hpp"
#include "vantage/reconstruction/observation_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  const auto file = fuzz::file_with("seen.jsonl", fuzz::text_of(data, size));
  return fuzz::only_errors([&] { (void)read_observations(file); });
}
