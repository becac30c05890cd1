#include "dataset/image_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint32_t kMaxSide = 16384;
constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

struct Header {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  int bits = 0;
};

[[noreturn]] void truncated(const std::filesystem::path& path, std::size_t size) {
  throw bad_input(path.string(),
                  fmt::format("truncated: the image does not end within the file's {} bytes; "
                              "copy or record it again",
                              size));
}

std::uint32_t big_endian(Bytes bytes, std::size_t at, int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value = value << 8 | bytes[at + std::size_t(i)];
  return value;
}

bool starts_with(Bytes bytes, Bytes start) {
  return bytes.size() >= start.size() && std::equal(start.begin(), start.end(), bytes.begin());
}

/// Walks the chunks (length, type, data, checksum) up to IEND.
Header png_header(Bytes bytes, const std::filesystem::path& path) {
  constexpr std::uint32_t kIhdr = 0x49484452, kIend = 0x49454E44;
  constexpr std::size_t kChunkOverhead = 12;
  Header header;
  std::size_t at = kPngSignature.size();
  while (bytes.size() - at >= kChunkOverhead) {
    const std::size_t length = big_endian(bytes, at, 4);
    const std::uint32_t type = big_endian(bytes, at + 4, 4);
    if (length > bytes.size() - at - kChunkOverhead) break;
    if (at == kPngSignature.size()) {
      if (type != kIhdr || length != 13) throw bad_input(path.string(), "PNG without a header");
      header = {big_endian(bytes, at + 8, 4), big_endian(bytes, at + 12, 4), bytes[at + 16]};
    }
    if (type == kIend) return header;
    at += length + kChunkOverhead;
  }
  truncated(path, bytes.size());
}

/// Baseline, extended and progressive frames, C0 to CF, without the three other markers among them.
bool is_frame(std::uint8_t marker) {
  return marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
}

bool stands_alone(std::uint8_t marker) {
  return marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8);
}

/// Walks the segments (0xFF, marker, length, data) and skips the compressed data behind each scan's
/// header, up to the end marker.
Header jpeg_header(Bytes bytes, const std::filesystem::path& path) {
  constexpr std::uint8_t kEnd = 0xD9;
  Header header;
  std::size_t at = 2;
  while (at + 1 < bytes.size()) {
    const std::uint8_t marker = bytes[at + 1];
    if (bytes[at] != 0xFF || marker == 0x00 || marker == 0xFF) {
      ++at;  // compressed data, or a byte that fills up
    } else if (marker == kEnd) {
      if (header.bits == 0) throw bad_input(path.string(), "JPEG without a frame header");
      return header;
    } else if (stands_alone(marker)) {
      at += 2;
    } else {
      if (bytes.size() - at < 4) break;
      const std::size_t length = big_endian(bytes, at + 2, 2);
      if (length < 2 || length > bytes.size() - at - 2) break;
      if (is_frame(marker) && length >= 8) {
        header = {big_endian(bytes, at + 7, 2), big_endian(bytes, at + 5, 2), bytes[at + 4]};
      }
      at += 2 + length;
    }
  }
  truncated(path, bytes.size());
}

}  // namespace

ImageSize check_color_header(Bytes bytes, const std::filesystem::path& path) {
  constexpr std::array<std::uint8_t, 3> kJpegSignature = {0xFF, 0xD8, 0xFF};
  Header header;
  if (starts_with(bytes, kPngSignature)) {
    header = png_header(bytes, path);
  } else if (starts_with(bytes, kJpegSignature)) {
    header = jpeg_header(bytes, path);
  } else {
    throw bad_input(path.string(), "neither PNG nor JPEG; save the colour image as one of them");
  }
  if (header.bits > 8) {
    throw bad_input(path.string(), fmt::format("{} bits per channel; expected a colour image of 8 "
                                               "bits (16 bits are for depth)",
                                               header.bits));
  }
  if (std::min(header.width, header.height) < 1 ||
      std::max(header.width, header.height) > kMaxSide) {
    throw bad_input(path.string(), fmt::format("{} x {} pixels; expected 1 to {} along each side",
                                               header.width, header.height, kMaxSide));
  }
  return {int(header.width), int(header.height)};
}

}  // namespace vantage::reconstruction::detail
