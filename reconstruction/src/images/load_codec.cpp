#include "images/load_codec.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

namespace vantage::reconstruction::detail {
namespace {

std::filesystem::path folder_of_this_library() {
  Dl_info here{};
  if (::dladdr(reinterpret_cast<const void*>(&image_codec), &here) == 0 || !here.dli_fname)
    return {};
  return std::filesystem::absolute(here.dli_fname).parent_path();
}

const ImageCodec* load() {
  const auto path = folder_of_this_library() / "libvantage_codecs.so";
  void* library =
      ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);  // for as long as the process lives
  void* symbol = library ? ::dlsym(library, kImageCodecSymbol) : nullptr;
  if (!symbol) {
    const char* why = ::dlerror();
    throw std::runtime_error(fmt::format("{}: cannot be loaded: {}; install vantage again",
                                         path.string(), why ? why : "unknown reason"));
  }
  return reinterpret_cast<decltype(&image_codec_table)>(symbol)();
}

}  // namespace

const ImageCodec& image_codec() {
  static const ImageCodec* codec = load();
  return *codec;
}

}  // namespace vantage::reconstruction::detail
