#pragma once

#include <filesystem>
#include <memory>

#include "vantage/raycore/depth_image.hpp"

namespace vantage::reconstruction::detail {

/// A depth image as it was read.
struct DepthFile {
  std::shared_ptr<const DepthImage> depth;
  double saturated_share = 0;  ///< of the pixels, with the count `DepthImage::kSaturatedCount`
};

/// Reads depth by the file's ending: .png and .tif of 16 bits, .tif of 32 bits, .exr of floating
/// point (its channel Z, else Y, else R, else the only one), and .npy of uint16, float32 or float64
/// in rows of pixels. A value times `depth_scale_mm` is in millimetres, whatever its type. Zero,
/// NaN and infinity are unknown, and so is `DepthImage::kSaturatedCount` in 16 bits.
/// @throws Error bad_input if the file is missing, damaged, of another kind, negative somewhere, or
/// above 16384 pixels along a side.
DepthFile read_depth(const std::filesystem::path& file, double depth_scale_mm);

}  // namespace vantage::reconstruction::detail
