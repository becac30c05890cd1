#pragma once

#include "vantage/raycore/depth_image.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/lens.hpp"

namespace vantage {

/// A depth image that is distorted by a lens, as a pinhole with the lens' intrinsics would have it:
/// what cameras here are. Every pixel takes the depth of the pixel that shows the same direction,
/// not a mean of several, as there is nothing between two surfaces. What the lens does not show is
/// unknown.
/// @throws Error bad_input if image and intrinsics differ in size.
VANTAGE_API DepthImage rectify_depth(const DepthImage& depth, const Lens& lens,
                                     std::string_view where = "depth");

/// How far the lens moves what a pinhole shows, at most over the image; pixels.
VANTAGE_API double max_displacement_px(const Lens& lens);

}  // namespace vantage
