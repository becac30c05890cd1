// scene_camera.json of a BOP scene without depth images.
#include "fuzz_input.hpp"
#include "vantage/reconstruction/bop_scene.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  fuzz::file_with("scene_camera.json", fuzz::text_of(data, size));
  return fuzz::only_errors([] { (void)load_bop_scene(fuzz::folder()); });
}
