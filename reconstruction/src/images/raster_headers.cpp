#include "images/raster_headers.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <set>
#include <string_view>

namespace vantage::reconstruction::detail {
namespace {

using RasterBytes = std::span<const std::uint8_t>;

bool reads(RasterBytes bytes, std::size_t at, std::string_view text) {
  return bytes.size() >= at && bytes.size() - at >= text.size() &&
         std::equal(text.begin(), text.end(), bytes.begin() + std::ptrdiff_t(at),
                    [](char a, std::uint8_t b) { return std::uint8_t(a) == b; });
}

std::uint32_t little_endian(RasterBytes bytes, std::size_t at, std::size_t count) {
  std::uint32_t value = 0;
  for (std::size_t i = count; i-- > 0;) value = value << 8 | bytes[at + i];
  return value;
}

/// Numbers of a TIFF file, whose first two letters say in which order their bytes are.
class TiffNumbers {
 public:
  explicit TiffNumbers(RasterBytes bytes) : bytes_(bytes), little_(reads(bytes, 0, "II")) {}

  bool is_tiff() const {
    return (little_ || reads(bytes_, 0, "MM")) && number(2, 2) == std::uint32_t(42);
  }
  std::optional<std::uint32_t> number(std::size_t at, std::size_t count) const {
    if (at > bytes_.size() || bytes_.size() - at < count) return std::nullopt;
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      value = value << 8 | bytes_[at + (little_ ? count - 1 - i : i)];
    }
    return value;
  }
  /// The first value of a tag's entry: a short or a long number, in the entry or where it points.
  std::optional<std::uint32_t> value_at(std::size_t entry) const {
    constexpr std::uint32_t kShort = 3, kLong = 4;
    const auto type = number(entry + 2, 2), count = number(entry + 4, 4);
    if (!count || (type != kShort && type != kLong)) return std::nullopt;
    const std::size_t width = type == kShort ? 2 : 4;
    if (*count * width <= 4) return number(entry + 8, width);
    const auto place = number(entry + 8, 4);
    return place ? number(*place, width) : std::nullopt;
  }

 private:
  RasterBytes bytes_;
  bool little_;
};

constexpr std::uint32_t kSampleFormat = 339, kUnsigned = 1, kFloat = 3;

void take_tag(std::uint32_t tag, std::uint32_t value, RasterHeader& header) {
  constexpr std::uint32_t kWidth = 256, kHeight = 257, kBits = 258, kOrientation = 274;
  if (tag == kWidth) header.width = value;
  if (tag == kHeight) header.height = value;
  if (tag == kBits) header.bits = int(std::min(value, 1000u));
  if (tag == kOrientation && value >= 1 && value <= 8) header.exif_orientation = int(value);
  if (tag == kSampleFormat) header.is_float = value == kFloat;
}

}  // namespace

std::optional<RasterHeader> tiff_header(RasterBytes bytes) {
  const TiffNumbers numbers(bytes);
  if (!numbers.is_tiff()) return std::nullopt;
  const auto directory = numbers.number(4, 4);
  const auto count = directory ? numbers.number(*directory, 2) : std::nullopt;
  if (!count) return std::nullopt;
  RasterHeader header;
  header.bits = 1;  // where a TIFF says nothing
  std::set<std::uint32_t>
      taken;  // of a tag that is there twice the first one counts, as in libtiff
  for (std::uint32_t i = 0; i < *count; ++i) {
    const std::size_t entry = std::size_t(*directory) + 2 + 12 * std::size_t(i);
    const auto tag = numbers.number(entry, 2);
    if (!tag) return std::nullopt;
    const auto value = numbers.value_at(entry);
    if (!value || !taken.insert(*tag).second) continue;
    take_tag(*tag, *value, header);
    if (*tag == kSampleFormat && *value == kUnsigned) header.unsigned_at = entry + 8;
  }
  return header;
}

std::optional<RasterHeader> bmp_header(RasterBytes bytes) {
  constexpr std::size_t kSmallest = 30;
  if (!reads(bytes, 0, "BM") || bytes.size() < kSmallest) return std::nullopt;
  // A negative height says that the rows go from top to bottom.
  const auto side = [&](std::size_t at) {
    return std::uint32_t(std::abs(std::int64_t(std::int32_t(little_endian(bytes, at, 4)))));
  };
  return RasterHeader{side(18), side(22), 8};
}

std::optional<RasterHeader> webp_header(RasterBytes bytes) {
  constexpr std::size_t kSmallest = 30;
  if (!reads(bytes, 0, "RIFF") || !reads(bytes, 8, "WEBP") || bytes.size() < kSmallest) {
    return std::nullopt;
  }
  RasterHeader header;
  header.bits = 8;
  if (reads(bytes, 12, "VP8 ")) {
    header.width = little_endian(bytes, 26, 2) & 0x3FFF;
    header.height = little_endian(bytes, 28, 2) & 0x3FFF;
  } else if (reads(bytes, 12, "VP8L")) {
    const std::uint32_t sides = little_endian(bytes, 21, 4);
    header.width = (sides & 0x3FFF) + 1, header.height = (sides >> 14 & 0x3FFF) + 1;
  } else if (reads(bytes, 12, "VP8X")) {
    header.width = little_endian(bytes, 24, 3) + 1, header.height = little_endian(bytes, 27, 3) + 1;
  } else {
    return std::nullopt;
  }
  for (std::size_t at = 12; bytes.size() - at >= 8;) {  // chunks: name, length, content, padding
    const std::size_t length = little_endian(bytes, at + 4, 4), left = bytes.size() - at - 8;
    if (length > left) break;
    if (reads(bytes, at, "EXIF")) {
      header.exif_orientation = exif_orientation(bytes.subspan(at + 8, length));
    }
    at += std::min(8 + length + length % 2, bytes.size() - at);
  }
  return header;
}

int exif_orientation(RasterBytes exif) {
  constexpr std::string_view kStart("Exif\0\0", 6);
  if (reads(exif, 0, kStart)) exif = exif.subspan(kStart.size());
  const auto header = tiff_header(exif);
  return header ? header->exif_orientation : 1;
}

}  // namespace vantage::reconstruction::detail
