// PNG through libpng. libpng reports an error by longjmp, which runs no destructors: the functions
// that call setjmp, and libpng's callbacks, therefore own nothing that has one.
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <cstring>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/detail/limits.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/image_io.hpp"

namespace vantage {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeaderBytes = 8 + 8 + 13;  // signature, IHDR's length and name, its content
/// Deflate packs 258 bytes into no less than two bits.
constexpr std::uint64_t kMaxDeflateRatio = 1032;

using Message = std::array<char, 160>;

[[noreturn]] void on_error(png_structp png, png_const_charp text) {
  auto* message = static_cast<Message*>(png_get_error_ptr(png));
  std::snprintf(message->data(), message->size(), "%s", text);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}  // libpng would print it

/// libpng's state for writing one image into a string.
class Encoder {
 public:
  Encoder()
      : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &message_, on_error, on_warning)),
        info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {
    if (info_ != nullptr) return;
    png_destroy_write_struct(&png_, &info_);
    throw std::bad_alloc();
  }
  ~Encoder() { png_destroy_write_struct(&png_, &info_); }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  bool encode(png_uint_32 width, png_uint_32 height, int bits, int color_type, int effort,
              png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_write_fn(png_, &bytes_, append, nullptr);
    png_set_IHDR(png_, info_, width, height, bits, color_type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_compression_level(png_, effort);
    png_write_info(png_, info_);
    if (bits == 16 && std::endian::native == std::endian::little) png_set_swap(png_);
    png_write_image(png_, rows);
    png_write_end(png_, nullptr);
    return true;
  }

  const std::string& bytes() const { return bytes_; }
  const char* message() const { return message_.data(); }

 private:
  static void append(png_structp png, png_bytep data, std::size_t size) {
    bool done = false;
    try {
      static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<char*>(data), size);
      done = true;
    } catch (const std::exception&) {
    }
    if (!done) png_error(png, "out of memory");  // outside the handler: it does not come back
  }

  Message message_ = {};
  std::string bytes_;
  png_structp png_;
  png_infop info_;
};

/// libpng's state for reading one image out of memory.
class Decoder {
 public:
  explicit Decoder(std::span<const std::uint8_t> bytes)
      : bytes_(bytes),
        png_(png_create_read_struct(PNG_LIBPNG_VER_STRING, &message_, on_error, on_warning)),
        info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {
    if (info_ != nullptr) return;
    png_destroy_read_struct(&png_, &info_, nullptr);
    throw std::bad_alloc();
  }
  ~Decoder() { png_destroy_read_struct(&png_, &info_, nullptr); }
  Decoder(const Decoder&) = delete;
  Decoder& operator=(const Decoder&) = delete;

  /// `rows` have to have the size that the file's header has.
  bool decode(png_bytepp rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_user_limits(png_, limits::kMaxImageSide, limits::kMaxImageSide);
    png_set_read_fn(png_, &bytes_, take);
    png_read_info(png_, info_);
    if (std::endian::native == std::endian::little) png_set_swap(png_);
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

  const char* message() const { return message_.data(); }

 private:
  static void take(png_structp png, png_bytep data, std::size_t size) {
    auto* left = static_cast<std::span<const std::uint8_t>*>(png_get_io_ptr(png));
    if (size > left->size()) png_error(png, "the file ends early");
    std::memcpy(data, left->data(), size);
    *left = left->subspan(size);
  }

  Message message_ = {};
  std::span<const std::uint8_t> bytes_;
  png_structp png_;
  png_infop info_;
};

template <class Sample, int kChannels>
std::vector<png_bytep> row_pointers(const Image<Sample, kChannels>& image) {
  std::vector<png_bytep> rows;
  for (int v = 0; v < image.height; ++v) {
    // libpng takes rows to write without const, too; it does not change them.
    rows.push_back(reinterpret_cast<png_bytep>(const_cast<Sample*>(image.pixel(0, v))));
  }
  return rows;
}

template <class Sample, int kChannels>
void write_image(const fs::path& path, const Image<Sample, kChannels>& image, int color_type,
                 int effort) {
  const bool has_pixels = image.width > 0 && image.height > 0;
  const std::size_t expected =
      has_pixels ? std::size_t(image.width) * std::size_t(image.height) * kChannels : 0;
  if (!has_pixels || image.samples.size() != expected) {
    throw bad_input(path.string(),
                    fmt::format("an image of {} x {} pixels with {} samples cannot be written; "
                                "expected at least one pixel and {} samples for each",
                                image.width, image.height, image.samples.size(), kChannels));
  }
  std::vector<png_bytep> rows = row_pointers(image);
  Encoder encoder;
  if (!encoder.encode(png_uint_32(image.width), png_uint_32(image.height), 8 * sizeof(Sample),
                      color_type, effort, rows.data())) {
    throw bad_input(path.string(), fmt::format("cannot be encoded as PNG: {}", encoder.message()));
  }
  write_file(path, encoder.bytes());
}

const char* color_type_name(int color_type) {
  switch (color_type) {
    case PNG_COLOR_TYPE_GRAY:
      return "grey";
    case PNG_COLOR_TYPE_GRAY_ALPHA:
      return "grey with alpha";
    case PNG_COLOR_TYPE_RGB:
      return "RGB";
    case PNG_COLOR_TYPE_RGB_ALPHA:
      return "RGB with alpha";
    case PNG_COLOR_TYPE_PALETTE:
      return "palette";
    default:
      return "an unknown colour type";
  }
}

struct Size {
  std::uint32_t width;
  std::uint32_t height;
};

/// The size that the header states, before anything is allocated for it.
Size check_header(std::span<const std::uint8_t> bytes, const std::string& file) {
  if (bytes.empty()) throw bad_input(file, "is empty; expected a 16-bit grey PNG");
  if (png_sig_cmp(bytes.data(), 0, std::min<std::size_t>(bytes.size(), 8)) != 0) {
    throw bad_input(file, "is not a PNG (its first bytes differ); expected a 16-bit grey PNG");
  }
  if (bytes.size() < kHeaderBytes) {
    throw bad_input(file, fmt::format("ends after {} bytes, within the PNG header; it is truncated",
                                      bytes.size()));
  }
  if (std::memcmp(bytes.data() + 8, "\0\0\0\15IHDR", 8) != 0) {
    throw bad_input(file, "is a damaged PNG: it does not begin with the chunk IHDR");
  }
  const Size size = {png_get_uint_32(bytes.data() + 16), png_get_uint_32(bytes.data() + 20)};
  const int bits = bytes[24];
  const int color_type = bytes[25];
  if (color_type != PNG_COLOR_TYPE_GRAY) {
    throw bad_input(file, fmt::format("is {}, {} bits per sample; depth needs a grey PNG of 16",
                                      color_type_name(color_type), bits));
  }
  if (bits != 16) {
    throw bad_input(file, fmt::format("has {} bits per sample; depth needs 16", bits));
  }
  if (size.width == 0 || size.height == 0 || size.width > limits::kMaxImageSide ||
      size.height > limits::kMaxImageSide ||
      std::uint64_t(size.width) * size.height > limits::kMaxImagePixels) {
    throw bad_input(
        file, fmt::format("states {} x {} pixels; expected 1 to {} along each side, and "
                          "at most {} in all",
                          size.width, size.height, limits::kMaxImageSide, limits::kMaxImagePixels));
  }
  const std::uint64_t needed = std::uint64_t(2) * size.width * size.height;
  if (needed > kMaxDeflateRatio * bytes.size()) {
    throw bad_input(file, fmt::format("states {} x {} pixels, more than {} bytes can hold; it is "
                                      "truncated or damaged",
                                      size.width, size.height, bytes.size()));
  }
  return size;
}

}  // namespace

void write_png(const fs::path& path, const ColorImage& image, int effort) {
  write_image(path, image, PNG_COLOR_TYPE_RGB, effort);
}

void write_png(const fs::path& path, const RawDepthImage& image) {
  write_image(path, image, PNG_COLOR_TYPE_GRAY, 6);
}

RawDepthImage read_png_counts(const fs::path& path,
                              const std::function<void(int width, int height)>& accept) {
  const std::vector<std::uint8_t> bytes = read_file(path, limits::kMaxImageBytes);
  const Size size = check_header(bytes, path.string());
  if (accept) accept(int(size.width), int(size.height));
  RawDepthImage image(int(size.width), int(size.height));
  std::vector<png_bytep> rows = row_pointers(image);
  Decoder decoder(bytes);
  if (!decoder.decode(rows.data())) {
    throw bad_input(path.string(), fmt::format("is a truncated or damaged PNG ({}); record or copy "
                                               "it again",
                                               decoder.message()));
  }
  return image;
}

}  // namespace vantage
