#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vantage {

/// A row-major image with interleaved channels.
template <class Sample, int kChannels>
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Sample> samples;  ///< height x width x kChannels

  Image() = default;
  Image(int w, int h, Sample value = {})
      : width(w), height(h), samples(std::size_t(w) * std::size_t(h) * kChannels, value) {}

  Sample* pixel(int u, int v) { return samples.data() + offset(u, v); }
  const Sample* pixel(int u, int v) const { return samples.data() + offset(u, v); }
  bool operator==(const Image&) const = default;

 private:
  std::size_t offset(int u, int v) const {
    return (std::size_t(v) * std::size_t(width) + std::size_t(u)) * kChannels;
  }
};

using ColorImage = Image<std::uint8_t, 3>;      ///< sRGB, red first
using RawDepthImage = Image<std::uint16_t, 1>;  ///< raw depth as sensors store it

}  // namespace vantage
