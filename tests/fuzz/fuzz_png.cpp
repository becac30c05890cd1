// Depth images. Checksums are put right, so that mutants get beyond them.
#include <zlib.h>

#include <string>

#include "fuzz_input.hpp"
#include "vantage/raycore/image_io.hpp"

namespace {

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i)
    value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// Of every chunk: length, type, data, and then the checksum of type and data.
void mend_checksums(std::string& bytes) {
  for (std::size_t at = 8; at + 12 <= bytes.size();) {
    const std::size_t length = big_endian(bytes, at);
    if (length > bytes.size() - at - 12) return;
    const auto* type = reinterpret_cast<const Bytef*>(bytes.data() + at + 4);
    const std::uint32_t sum = std::uint32_t(crc32(0, type, uInt(length + 4)));
    for (std::size_t i = 0; i < 4; ++i) {
      bytes[at + 8 + length + i] = char(sum >> (24 - 8 * i) & 0xFF);
    }
    at += 12 + length;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vantage;
  std::string bytes(fuzz::text_of(data, size));
  mend_checksums(bytes);
  const auto file = fuzz::file_with("depth.png", bytes);
  return fuzz::only_errors([&] { (void)read_png_counts(file); });
}
