#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <fmt/format.h>

#include <cstring>
#include <exception>

#include "images/depth_decoders.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage::reconstruction::detail {
namespace {

/// A file in memory, for OpenEXR.
class ExrBytes final : public Imf::IStream {
 public:
  ExrBytes(std::span<const std::uint8_t> bytes, const std::string& name)
      : Imf::IStream(name.c_str()), bytes_(bytes) {}

  bool read(char to[], int count) override {
    if (count < 0 || std::uint64_t(count) > bytes_.size() - at_) {
      throw std::runtime_error("the file ends early");
    }
    std::memcpy(to, bytes_.data() + at_, std::size_t(count));
    at_ += std::uint64_t(count);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t to) override {
    if (to > bytes_.size()) throw std::runtime_error("it points past its end");
    at_ = to;
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::uint64_t at_ = 0;
};

std::string depth_channel(const Imf::ChannelList& channels, const std::string& where) {
  for (const char* name : {"Z", "Y", "R"}) {
    if (channels.findChannel(name) != nullptr) return name;
  }
  const auto first = channels.begin();
  if (first != channels.end()) {
    auto second = first;
    if (++second == channels.end()) return first.name();
  }
  throw bad_input(where, "none of its channels is Z, Y or R; expected one channel with depth");
}

Image<float, 1> read_exr(std::span<const std::uint8_t> bytes, const std::string& where) {
  ExrBytes stream(bytes, where);
  Imf::InputFile file(stream, 0);
  const Imath::Box2i window = file.header().dataWindow();
  const std::int64_t width = std::int64_t(window.max.x) - window.min.x + 1;
  const std::int64_t height = std::int64_t(window.max.y) - window.min.y + 1;
  check_depth_size(width, height, bytes.size(), where);
  const std::string channel = depth_channel(file.header().channels(), where);
  const Imf::Channel& kind = file.header().channels()[channel.c_str()];
  if (kind.xSampling != 1 || kind.ySampling != 1) {
    throw bad_input(where, fmt::format("its channel {} leaves out pixels", channel));
  }
  Image<float, 1> image{int(width), int(height)};
  const std::size_t row = sizeof(float) * std::size_t(width);
  Imf::FrameBuffer frame;
  frame.insert(channel,
               Imf::Slice::Make(Imf::FLOAT, image.samples.data(), window, sizeof(float), row));
  file.setFrameBuffer(frame);
  file.readPixels(window.min.y, window.max.y);
  return image;
}

}  // namespace

RawDepth decode_depth_exr(std::span<const std::uint8_t> bytes, const std::string& where) {
  try {
    return read_exr(bytes, where);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw bad_input(
        where, fmt::format("OpenEXR cannot read it: {}; record or copy it again", error.what()));
  }
}

}  // namespace vantage::reconstruction::detail
