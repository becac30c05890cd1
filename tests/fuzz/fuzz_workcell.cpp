// A workcell file, with whatever it names beside it missing.
#include "fuzz_input.hpp"
#include "workcell/workcell.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  const auto file = fuzz::file_with("cell.yaml", fuzz::text_of(data, size));
  return fuzz::only_errors([&] { (void)load_workcell(file); });
}
