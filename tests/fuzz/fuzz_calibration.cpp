// Calibrations of cameras.
#include "fuzz_input.hpp"
#include "vantage/reconstruction/calibration.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  const auto file = fuzz::file_with("camera.yml", fuzz::text_of(data, size));
  return fuzz::only_errors([&] { (void)read_calibration(file, 640, 480); });
}
