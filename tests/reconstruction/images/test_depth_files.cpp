#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "reconstruction/encoded_image.hpp"
#include "reconstruction/scene_folder.hpp"
#include "support/expect_error.hpp"
#include "vantage/reconstruction/bop_scene.hpp"

namespace vantage::test {
namespace {

template <class T>
std::string raw(const std::vector<T>& values) {
  std::string bytes(values.size() * sizeof(T), '\0');
  std::memcpy(bytes.data(), values.data(), bytes.size());
  return bytes;
}

std::string npy(const std::string& type, const std::string& shape, const std::string& data) {
  std::string header =
      "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  header.resize(118, ' ');
  header.back() = '\n';
  return std::string("\x93NUMPY\x01\x00", 8) + char(header.size()) + '\0' + header + data;
}

/// 8 x 6 whole numbers of 32 bits, in one strip, uncompressed.
std::string tiff_of_32_bits(std::uint32_t value) {
  std::string file("II*\0\x08\0\0\0", 8);
  const std::uint32_t tags[][3] = {{256, 8, 0},   {257, 6, 0},   {258, 32, 0}, {259, 1, 0},
                                   {262, 1, 0},   {273, 134, 1}, {277, 1, 0},  {278, 6, 0},
                                   {279, 192, 1}, {339, 1, 0}};
  file += raw<std::uint16_t>({10});
  for (const auto& [tag, number, is_long] : tags) {
    file += raw<std::uint16_t>({std::uint16_t(tag), std::uint16_t(is_long ? 4 : 3)});
    file += raw<std::uint32_t>({1, number});
  }
  file += raw<std::uint32_t>({0});
  REQUIRE(file.size() == 134);
  return file + raw(std::vector<std::uint32_t>(48, value));
}

/// Depth of image 7, of 0.5 mm a count, from a file with this ending.
std::shared_ptr<const DepthImage> depth_in(const std::string& ending, const std::string& bytes) {
  SceneFolder folder;
  folder.good_entry().write("depth/000007" + ending, bytes);
  return load_bop_scene(folder.path()).images.at(0).depth;
}

std::string exr(const char* channel) {
  const TemporaryFolder folder;
  const std::string file = (folder / "a.exr").string();
  std::vector<float> metres(48, 2000);
  metres[0] = std::numeric_limits<float>::infinity();
  {
    Imf::Header header(8, 6);
    header.channels().insert(channel, Imf::Channel(Imf::FLOAT));
    Imf::OutputFile out(file.c_str(), header);
    Imf::FrameBuffer frame;
    frame.insert(channel, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(metres.data()), 4, 32));
    out.setFrameBuffer(frame);
    out.writePixels(6);
  }
  return read_text(file);
}

}  // namespace

TEST_CASE("depth is read from TIFF of 16 and 32 bits, OpenEXR and NumPy's arrays alike") {
  const std::string counts = raw(std::vector<std::uint16_t>(48, 2000));
  const std::string floats = raw(std::vector<float>(48, 2000.0f));
  const std::string doubles = raw(std::vector<double>(48, 2000.0));
  for (const auto& file : std::vector<std::pair<std::string, std::string>>{
           {".tif", encoded_image(".tif", cv::Mat(6, 8, CV_16U, cv::Scalar(2000)))},
           {".TIFF", encoded_image(".tif", cv::Mat(6, 8, CV_32F, cv::Scalar(2000)))},
           {".tif", tiff_of_32_bits(2000)},
           {".npy", npy("<u2", "6, 8", counts)},
           {".npy", npy("<f4", "6, 8", floats)},
           {".npy", npy("<f8", "6, 8, 1", doubles)}}) {
    const std::string &ending = file.first, &bytes = file.second;
    CAPTURE(ending);
    const auto depth = depth_in(ending, bytes);
    REQUIRE(depth);
    CHECK(depth->width() == 8);
    CHECK(depth->height() == 6);
    CHECK(depth->at(3, 4) == 1.0f);
    // Cut off anywhere, it is refused.
    for (std::size_t size = 0; size + 4 < bytes.size(); size += 13) {
      CHECK_THROWS_AS(depth_in(ending, bytes.substr(0, size)), Error);
    }
  }
  for (const char* channel : {"Z", "Y", "R", "depth"}) {
    CAPTURE(channel);
    const auto depth = depth_in(".exr", exr(channel));
    CHECK(depth->at(3, 4) == 1.0f);
    CHECK(std::isnan(depth->at(0, 0)));
  }
  const std::string whole = exr("Z");
  for (std::size_t size = 0; size < whole.size(); size += 17) {
    CHECK_THROWS_AS(depth_in(".exr", whole.substr(0, size)), Error);
  }
}

TEST_CASE("rows stay rows, and what is unknown stays unknown") {
  std::vector<std::uint16_t> counts(48);
  for (std::size_t i = 0; i < 48; ++i) counts[i] = std::uint16_t(1000 + i);
  counts[5] = 0, counts[6] = 65535;
  cv::Mat image(6, 8, CV_16U, counts.data());
  for (const auto& depth : {depth_in(".npy", npy("<u2", "6, 8", raw(counts))),
                            depth_in(".tif", encoded_image(".tif", image))}) {
    CHECK(depth->at(3, 2) == doctest::Approx(0.0005 * (1000 + 2 * 8 + 3)));
    CHECK(std::isnan(depth->at(5, 0)));
    CHECK(std::isnan(depth->at(6, 0)));
  }
}

TEST_CASE("depth files of another kind are refused by what they are") {
  const auto refused = [](const std::string& ending, const std::string& bytes,
                          std::initializer_list<std::string_view> parts) {
    expect_refused([&] { depth_in(ending, bytes); }, "000007" + ending, parts);
  };
  refused(".tif", encoded_image(".tif", cv::Mat(6, 8, CV_8U, cv::Scalar(20))),
          {"8 bits per pixel"});
  refused(".tif", encoded_image(".tif", cv::Mat(6, 8, CV_16UC3, cv::Scalar(20, 2, 1))),
          {"channels"});
  refused(".tif", "no image", {"not a TIFF image"});
  refused(".npy", npy("<i4", "6, 8", std::string(192, 'a')), {"\"<i4\"", "uint16"});
  refused(".npy", npy("<u2", "48", std::string(96, 'a')), {"(48)", "(height, width)"});
  refused(".npy", npy("<u2", "6, 9", std::string(96, 'a')), {"96 bytes", "expected 108"});
  refused(".npy", npy("<u2", "99999, 9", std::string(96, 'a')), {"9 x 99999", "16384"});
  refused(".npy", npy("<f4", "6, 8", raw(std::vector<float>(48, -1.0f))), {"expected 0 or more"});
  refused(".exr", "no image", {"OpenEXR cannot read it"});
}

}  // namespace vantage::test
