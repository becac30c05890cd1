#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>

#include "vantage/raycore/image.hpp"

namespace vantage::reconstruction::detail {

/// Depth as it is stored: counts of 16 bits, or numbers. Both are multiplied by the scene's scale.
using RawDepth = std::variant<RawDepthImage, Image<float, 1>>;

/// The decoders of depth files other than PNG. Sizes are checked before anything is allocated.
/// @throws Error bad_input at `where`.
RawDepth decode_depth_tiff(std::span<const std::uint8_t> bytes, const std::string& where);
RawDepth decode_depth_exr(std::span<const std::uint8_t> bytes, const std::string& where);
RawDepth decode_depth_npy(std::span<const std::uint8_t> bytes, const std::string& where);

/// @throws Error bad_input for an invalid size, above 16384 along a side, or more than so many
/// bytes can hold, however well they are packed.
void check_depth_size(std::int64_t width, std::int64_t height, std::size_t bytes,
                      const std::string& where);

}  // namespace vantage::reconstruction::detail
