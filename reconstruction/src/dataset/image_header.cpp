#include "dataset/image_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "images/raster_headers.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::uint32_t kMaxSide = 16384;
constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

using Header = RasterHeader;

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
  constexpr std::uint32_t kIhdr = 0x49484452, kIend = 0x49454E44, kExif = 0x65584966;
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
    if (type == kExif) header.exif_orientation = exif_orientation(bytes.subspan(at + 8, length));
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
  constexpr std::uint8_t kEnd = 0xD9, kExif = 0xE1;
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
        header.width = big_endian(bytes, at + 7, 2), header.height = big_endian(bytes, at + 5, 2);
        header.bits = bytes[at + 4];
      }
      if (marker == kExif && length > 8) {
        header.exif_orientation = exif_orientation(bytes.subspan(at + 4, length - 2));
      }
      at += 2 + length;
    }
  }
  truncated(path, bytes.size());
}

Header header_of(Bytes bytes, const std::filesystem::path& path) {
  constexpr std::array<std::uint8_t, 3> kJpegSignature = {0xFF, 0xD8, 0xFF};
  if (starts_with(bytes, kPngSignature)) return png_header(bytes, path);
  if (starts_with(bytes, kJpegSignature)) return jpeg_header(bytes, path);
  for (const auto read : {tiff_header, bmp_header, webp_header}) {
    if (const auto header = read(bytes)) return *header;
  }
  throw bad_input(
      path.string(),
      "not a PNG, JPEG, TIFF, BMP or WebP image; save the colour image as one of these");
}

}  // namespace

ColorHeader check_color_header(Bytes bytes, const std::filesystem::path& path) {
  const Header header = header_of(bytes, path);
  if (header.bits > 16 || header.is_float) {
    throw bad_input(path.string(),
                    fmt::format("{} bits per channel{}; expected a colour image of 8 or 16 bits",
                                header.bits, header.is_float ? ", as floating point" : ""));
  }
  if (std::min(header.width, header.height) < 1 ||
      std::max(header.width, header.height) > kMaxSide) {
    throw bad_input(path.string(), fmt::format("{} x {} pixels; expected 1 to {} along each side",
                                               header.width, header.height, kMaxSide));
  }
  return {{int(header.width), int(header.height)}, header.exif_orientation};
}

std::string orientation_warning(const ColorHeader& header, const std::filesystem::path& path) {
  if (header.exif_orientation == 1) return {};
  return fmt::format(
      "{}: its EXIF data ask for a rotated picture (orientation {}); it is used as stored: check "
      "that the intrinsics are for {} x {} pixels, as the camera recorded them",
      path.string(), header.exif_orientation, header.size.width, header.size.height);
}

}  // namespace vantage::reconstruction::detail
