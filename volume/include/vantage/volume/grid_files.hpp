#pragma once

#include <filesystem>

#include "vantage/raycore/export.hpp"
#include "vantage/volume/advanced/shadow_regions.hpp"
#include "vantage/volume/state_grid.hpp"

namespace vantage {

// NumPy arrays of shape (nx, ny, nz), C order, indexed [i, j, k]; written row by row, so that they
// may be larger than memory.

/// The states as uint8: 0 free, 1 occupied, 2 shadow, 3 revealed.
/// @throws Error as `write_file` does.
VANTAGE_API void write_labels_npy(const std::filesystem::path& path, const StateGrid& grid);

/// The labels of the shadow regions as int32: 0 none, 1 the largest …
/// @throws Error as `write_file` does.
VANTAGE_API void write_regions_npy(const std::filesystem::path& path, const ShadowRegions& regions);

}  // namespace vantage
