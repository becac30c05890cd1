// Reach maps.
#include "fuzz_input.hpp"
#include "workcell/npy_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  const auto file = fuzz::file_with("map.npy", fuzz::text_of(data, size));
  return fuzz::only_errors([&] { (void)read_npy_bytes(file); });
}
