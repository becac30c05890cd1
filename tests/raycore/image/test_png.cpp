#include <doctest/doctest.h>
#include <fmt/format.h>

#include <vantage/raycore/image_io.hpp>

#include "raycore/mesh_samples.hpp"
#include "support/expect_error.hpp"
#include "support/test_data.hpp"

using namespace vantage;

namespace {

// A string literal with zero bytes in it.
template <std::size_t kSize>
std::string bytes_of(const char (&literal)[kSize]) {
  return {literal, kSize - 1};
}

// 1 x 1 pixel, 8 bits, grey.
const std::string kGrey8 = bytes_of(
    "\x89PNG\r\n\x1a\n\x00\x00\x00\x0dIHDR\x00\x00\x00\x01\x00\x00\x00\x01\x08\x00\x00\x00\x00"
    "\x3a\x7e\x9b\x55\x00\x00\x00\x0aIDAT\x78\x9c\x63\xa8\x07\x00\x00\x81\x00\x80\xd3\x94\x53\x4a"
    "\x00\x00\x00\x00IEND\xae\x42\x60\x82");

// 2 x 2 pixels, 16 bits, grey, interlaced: 1, 2, 3, 400.
const std::string kInterlaced = bytes_of(
    "\x89PNG\r\n\x1a\n\x00\x00\x00\x0dIHDR\x00\x00\x00\x02\x00\x00\x00\x02\x10\x00\x00\x00\x01"
    "\x70\x4a\xbe\x2d\x00\x00\x00\x13IDAT\x78\x9c\x63\x60\x60\x64\x60\x60\x62\x60\x60\x66\x9c\x00"
    "\x00\x00\xbb\x00\x98\x03\x26\x12\x30\x00\x00\x00\x00IEND\xae\x42\x60\x82");

RawDepthImage ramp() {
  RawDepthImage image(31, 17);
  for (std::size_t i = 0; i < image.samples.size(); ++i) {
    image.samples[i] = std::uint16_t(i * 124 + i % 7);
  }
  return image;
}

std::string png_bytes(const test::TemporaryFolder& folder, const RawDepthImage& image) {
  write_png(folder / "made.png", image);
  return test::read_text(folder / "made.png");
}

void expect_refused(std::string_view bytes, std::string_view message) {
  const test::TemporaryFolder folder;
  const auto file = folder.write("depth.png", bytes);
  test::expect_bad_input("depth.png", message, [&] { read_png_counts(file); });
}

}  // namespace

TEST_CASE("16-bit counts come back as they were written") {
  const test::TemporaryFolder folder;
  RawDepthImage image = ramp();
  image.samples.front() = 0xFFFF;
  image.samples.back() = 0x0102;
  write_png(folder / "depth.png", image);
  CHECK(read_png_counts(folder / "depth.png") == image);
}

TEST_CASE("an interlaced image is read") {
  const test::TemporaryFolder folder;
  const RawDepthImage image = read_png_counts(folder.write("depth.png", kInterlaced));
  CHECK(image.width == 2);
  CHECK(image.samples == std::vector<std::uint16_t>{1, 2, 3, 400});
}

TEST_CASE("the same image gives the same bytes") {
  const test::TemporaryFolder folder;
  ColorImage image(20, 10);
  for (std::size_t i = 0; i < image.samples.size(); ++i) image.samples[i] = std::uint8_t(i * i);
  write_png(folder / "a.png", image);
  write_png(folder / "b.png", image);
  CHECK(test::read_text(folder / "a.png") == test::read_text(folder / "b.png"));
}

TEST_CASE("a colour image has 8 bits, RGB and its size in the header") {
  const test::TemporaryFolder folder;
  write_png(folder / "a.png", ColorImage(300, 2, 9));
  const std::string header = test::read_text(folder / "a.png").substr(16, 13);
  CHECK(header == bytes_of("\0\0\1\x2c\0\0\0\2\10\2\0\0\0"));
}

TEST_CASE("an image without pixels is not written") {
  const test::TemporaryFolder folder;
  test::expect_bad_input("a.png", "0 x 0 pixels",
                         [&] { write_png(folder / "a.png", RawDepthImage()); });
  test::expect_bad_input("a.png", "0 x 4", [&] { write_png(folder / "a.png", ColorImage(0, 4)); });
  RawDepthImage short_image(4, 4);
  short_image.samples.pop_back();
  test::expect_bad_input("a.png", "15 samples", [&] { write_png(folder / "a.png", short_image); });
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("what is not depth is refused before it is unpacked") {
  const test::TemporaryFolder folder;
  write_png(folder / "rgb.png", ColorImage(3, 3, 128));
  expect_refused(test::read_text(folder / "rgb.png"), "is RGB, 8 bits per sample; depth needs");
  expect_refused(kGrey8, "has 8 bits per sample; depth needs 16");
  expect_refused("", "is empty");
  expect_refused("this is a text, not a picture", "is not a PNG");
  test::expect_bad_input("none.png", "No such file", [&] { read_png_counts(folder / "none.png"); });
}

TEST_CASE("a file that ends early is refused, wherever it ends") {
  const test::TemporaryFolder folder;
  const std::string whole = png_bytes(folder, ramp());
  for (std::size_t size = 1; size < whole.size(); ++size) {
    CAPTURE(size);
    expect_refused(whole.substr(0, size), "truncated");
  }
}

TEST_CASE("a header that claims more than the file can hold is refused") {
  const test::TemporaryFolder folder;
  const std::string whole = png_bytes(folder, ramp());
  const std::string size = bytes_of("\0\0\0\x1f\0\0\0\x11");
  expect_refused(test::replaced(whole, size, bytes_of("\0\0\x1f\x40\0\0\x1f\x40")),
                 "states 8000 x 8000 pixels, more than");
  expect_refused(test::replaced(whole, size, bytes_of("\0\0\x40\0\0\0\x10\1")),
                 "states 16384 x 4097 pixels; expected 1 to 16384 along each side, and at most "
                 "67108864 in all");
  expect_refused(test::replaced(whole, size, bytes_of("\0\0\x40\1\0\0\0\1")),
                 "states 16385 x 1 pixels; expected 1 to 16384");
  expect_refused(test::replaced(whole, size, bytes_of("\0\0\0\0\0\0\0\x11")), "states 0 x 17");
  expect_refused(test::replaced(whole, "IHDR", "IHDX"), "does not begin with the chunk IHDR");
}

TEST_CASE("the size in the header can be refused before the pixels are decoded") {
  const test::TemporaryFolder folder;
  std::string bytes = png_bytes(folder, ramp());
  const auto file =
      folder.write("half.png", bytes.substr(0, bytes.size() / 2));  // no pixels to get
  const auto refuse = [](int width, int height) {
    throw bad_input("here", fmt::format("{} x {}", width, height));
  };
  test::expect_bad_input("here", "31 x 17", [&] { read_png_counts(file, refuse); });
}

TEST_CASE("a damaged byte never gives another image") {
  const test::TemporaryFolder folder;
  const RawDepthImage image = ramp();
  const std::string whole = png_bytes(folder, image);
  std::size_t refused = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    CAPTURE(i);
    std::string damaged = whole;
    damaged[i] = char(damaged[i] ^ 0x55);
    try {  // newer versions of libpng forgive damage behind the last pixel
      const RawDepthImage read = read_png_counts(folder.write("damaged.png", damaged));
      CHECK(read == image);
    } catch (const Error& error) {
      CHECK(error.code() == ErrorCode::bad_input);
      ++refused;
    }
  }
  CHECK(refused > whole.size() - 24);
  std::string damaged = whole;
  damaged[whole.size() - 16] = char(~damaged[whole.size() - 16]);  // the data's checksum
  expect_refused(damaged, "CRC");
}
