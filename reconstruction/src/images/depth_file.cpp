#include "images/depth_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "images/depth_decoders.hpp"
#include "vantage/raycore/detail/file.hpp"
#include "vantage/raycore/error.hpp"
#include "vantage/raycore/image_io.hpp"

namespace vantage::reconstruction::detail {
namespace {

constexpr double kMillimetresPerMetre = 1000;

DepthFile depth_of(const RawDepthImage& counts, double depth_scale_mm, const std::string& where) {
  const auto saturated = std::ranges::count(counts.samples, DepthImage::kSaturatedCount);
  return {
      std::make_shared<const DepthImage>(DepthImage::from_counts(counts, depth_scale_mm, where)),
      double(saturated) / double(counts.samples.size())};
}

DepthFile depth_of(const Image<float, 1>& numbers, double depth_scale_mm,
                   const std::string& where) {
  std::vector<float> metres = numbers.samples;
  for (float& depth : metres) depth = float(double(depth) * depth_scale_mm / kMillimetresPerMetre);
  return {
      std::make_shared<const DepthImage>(numbers.width, numbers.height, std::move(metres), where)};
}

RawDepth decode_depth(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending == ".png") return read_png_counts(file);
  const std::vector<std::uint8_t> bytes = read_file(file);
  const std::string where = file.string();
  if (ending == ".tif" || ending == ".tiff") return decode_depth_tiff(bytes, where);
  if (ending == ".exr") return decode_depth_exr(bytes, where);
  if (ending == ".npy") return decode_depth_npy(bytes, where);
  throw bad_input(where, fmt::format("depth in a file that ends in \"{}\"; expected .png, .tif, "
                                     ".exr or .npy",
                                     ending));
}

}  // namespace

void check_depth_size(std::int64_t width, std::int64_t height, std::size_t bytes,
                      const std::string& where) {
  constexpr std::int64_t kMaxSide_px = 16384;
  constexpr double kMaxPacked = 2000;  // pixels in a byte: more than any of the packers gets to
  if (width < 1 || height < 1 || width > kMaxSide_px || height > kMaxSide_px) {
    throw bad_input(where, fmt::format("{} x {} pixels; expected 1 to {} along each side", width,
                                       height, kMaxSide_px));
  }
  if (double(width) * double(height) > kMaxPacked * double(bytes)) {
    throw bad_input(where, fmt::format("states {} x {} pixels, more than {} bytes can hold; it is "
                                       "truncated or damaged",
                                       width, height, bytes));
  }
}

DepthFile read_depth(const std::filesystem::path& file, double depth_scale_mm) {
  return std::visit([&](const auto& raw) { return depth_of(raw, depth_scale_mm, file.string()); },
                    decode_depth(file));
}

}  // namespace vantage::reconstruction::detail
