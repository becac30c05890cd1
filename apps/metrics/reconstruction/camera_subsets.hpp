#pragma once

#include <cstddef>
#include <vector>

namespace vantage {

/// Indices of cameras, ascending.
using CameraSubset = std::vector<std::size_t>;

/// Every subset of `least` to `most` of the cameras: the small ones first, those of a size in
/// lexicographic order. For nine cameras and 2 to 9, these are 502.
/// @throws Error bad_input unless 1 <= least <= most <= cameras, and out_of_resources for more than
/// a million subsets.
std::vector<CameraSubset> camera_subsets(std::size_t cameras, std::size_t least, std::size_t most);

}  // namespace vantage
