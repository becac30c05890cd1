#include "vantage/reconstruction/color_image.hpp"

#include <doctest/doctest.h>

#include <opencv2/imgcodecs.hpp>
#include <string>

#include "reconstruction/encoded_image.hpp"
#include "support/expect_error.hpp"
#include "support/test_data.hpp"
#include "vantage/raycore/image_io.hpp"

namespace vantage::test {
namespace {

/// 16 x 8 pixels, the left half red, the right half blue; its EXIF data asks for a turn by 90°.
std::string jpeg() {
  constexpr std::string_view kHex =
      "ffd8ffe100224578696600004d4d002a00000008000101120003000000010006000000000000ffdb0043001b12"
      "141714111b1716171e1c1b2028422b28252528513a3d3042605565645f555d5b6a7899816a7190735b5d85b586"
      "909ea3abadab6780bcc9baa6c799a8aba4ffdb0043011c1e1e2823284e2b2b4ea46e5d6ea4a4a4a4a4a4a4a4a4"
      "a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4a4ffc00011"
      "080008001003012200021101031101ffc4001500010100000000000000000000000000000004ffc40014100100"
      "000000000000000000000000000000ffc40014010100000000000000000000000000000004ffc4001811000203"
      "0000000000000000000000000000054281c1ffda000c03010002110311003f00810818aa75a3d946f0ffd9";
  std::string bytes;
  for (std::size_t i = 0; i < kHex.size(); i += 2) {
    bytes += char(std::stoi(std::string(kHex.substr(i, 2)), nullptr, 16));
  }
  return bytes;
}

void expect_bytes_refused(std::string_view bytes, std::initializer_list<std::string_view> parts) {
  TemporaryFolder folder;
  const auto file = folder.write("image", bytes);
  expect_refused([&] { read_color(file); }, "image", parts);
}

std::string png(int width, int height) {
  TemporaryFolder folder;
  write_png(folder / "image.png", ColorImage(width, height, 200));
  return read_text(folder / "image.png");
}

}  // namespace

TEST_CASE("a PNG is read as it was written, red first") {
  TemporaryFolder folder;
  ColorImage image(5, 3);
  for (std::size_t i = 0; i < image.samples.size(); ++i) image.samples[i] = std::uint8_t(5 * i);
  write_png(folder / "image.png", image);
  CHECK(read_color(folder / "image.png") == image);
}

TEST_CASE("a JPEG is read as it is stored: its EXIF orientation does not turn it") {
  TemporaryFolder folder;
  const ColorImage image = read_color(folder.write("image.jpg", jpeg()));
  REQUIRE(image.width == 16);
  REQUIRE(image.height == 8);
  CHECK(image.pixel(2, 4)[0] > 200);
  CHECK(image.pixel(2, 4)[2] < 50);
  CHECK(image.pixel(13, 4)[0] < 50);
  CHECK(image.pixel(13, 4)[2] > 200);
}

TEST_CASE("a colour image that is missing or no image is refused") {
  TemporaryFolder folder;
  expect_refused([&] { read_color(folder / "nowhere.png"); }, "nowhere.png", {"o such file"});
  expect_bytes_refused("", {"not a PNG, JPEG, TIFF, BMP or WebP image"});
  expect_bytes_refused("GIF89a", {"not a PNG, JPEG, TIFF, BMP or WebP image"});
}

TEST_CASE("a colour image that ends too early is refused, wherever it is cut") {
  for (const std::string& whole : {png(6, 4), jpeg()}) {
    for (std::size_t size = 8; size < whole.size(); ++size) {
      CAPTURE(size);
      expect_bytes_refused(whole.substr(0, size), {"truncated", std::to_string(size)});
    }
  }
}

TEST_CASE("a colour image that claims too much is refused before it is decoded") {
  std::string image = png(6, 4);
  image.replace(16, 8, std::string("\x00\x01\x00\x00\x00\x01\x00\x00", 8));
  expect_bytes_refused(image, {"65536 x 65536", "16384"});
  image.replace(16, 8, std::string(8, '\0'));
  expect_bytes_refused(image, {"0 x 0"});

  std::string photograph = jpeg();
  const std::size_t frame = photograph.find("\xFF\xC0");
  photograph.replace(frame + 5, 4, "\xFF\xFF\xFF\xFF");
  expect_bytes_refused(photograph, {"65535 x 65535", "16384"});
}

TEST_CASE("16 bits become 8: full scale stays full scale") {
  TemporaryFolder folder;
  write_png(folder / "grey.png", RawDepthImage(6, 4, 65535));
  CHECK(read_color(folder / "grey.png") == ColorImage(6, 4, 255));
  write_png(folder / "grey.png", RawDepthImage(6, 4, 257 * 77));
  CHECK(read_color(folder / "grey.png") == ColorImage(6, 4, 77));
}

TEST_CASE("TIFF, BMP and WebP are read as PNG is") {
  TemporaryFolder folder;
  const cv::Mat bgr(3, 5, CV_8UC3, cv::Scalar(10, 120, 250));
  const cv::Mat deep(3, 5, CV_16UC3, cv::Scalar(257 * 10, 257 * 120, 257 * 250));
  ColorImage expected(5, 3);
  for (std::size_t i = 0; i < expected.samples.size(); i += 3) {
    expected.samples[i] = 250, expected.samples[i + 1] = 120, expected.samples[i + 2] = 10;
  }
  const auto read = [&](const char* ending, const cv::Mat& image, std::vector<int> how = {}) {
    const std::string text = encoded_image(ending, image, how);
    // What is cut off is corrupt, wherever it ends, and never a crash.
    for (std::size_t size = 0; size + 1 < text.size(); size += 7) {
      try {
        read_color(folder.write("cut", text.substr(0, size)));
      } catch (const Error& error) {
        CHECK(error.code() == ErrorCode::bad_input);
      }
    }
    return read_color(folder.write("image", text));
  };
  CHECK(read(".tif", bgr) == expected);
  CHECK(read(".tif", deep) == expected);
  CHECK(read(".png", deep) == expected);
  CHECK(read(".bmp", bgr) == expected);
  CHECK(read(".webp", bgr, {cv::IMWRITE_WEBP_QUALITY, 101}) == expected);  // lossless
  const std::string floats = encoded_image(".tif", cv::Mat(3, 5, CV_32FC1, cv::Scalar(1)));
  expect_bytes_refused(floats, {"32 bits", "floating point"});
}

TEST_CASE("a colour image whose data are damaged is refused") {
  std::string image = png(40, 30);
  const std::size_t data = image.find("IDAT");
  for (std::size_t i = data + 4; i < data + 20; ++i) image[i] = '\x55';
  expect_bytes_refused(image, {"corrupt"});

  std::string photograph = jpeg();
  photograph.erase(photograph.find("\xFF\xC0"), 2 + 17);
  expect_bytes_refused(photograph, {"JPEG without a frame header"});
}

}  // namespace vantage::test
