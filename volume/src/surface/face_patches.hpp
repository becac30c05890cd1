#pragma once

#include "grid/openvdb.hpp"

#include <compare>
#include <cstdint>
#include <vector>

namespace vantage::volume::detail {

/// Which way faces look, and in which plane they lie: index coordinate `position` along `axis`.
struct AxisPlane {
  std::int8_t axis, sign;
  std::int32_t position;
  auto operator<=>(const AxisPlane&) const = default;
};

/// 8 × 8 faces in a plane, bit 8 · row + column. Rows count along the axis after the plane's
/// (x after z), columns along the one after that.
struct FacePatch {
  AxisPlane plane;
  std::int32_t row, column;  ///< index coordinates of the first
  std::uint64_t faces;
  auto operator<=>(const FacePatch&) const = default;
};

/// The faces between the active voxels and all others, sorted.
std::vector<FacePatch> face_patches(const openvdb::MaskTree& voxels);

/// Some faces, in two parts.
struct SplitPatches {
  std::vector<FacePatch> open, covered;
};

/// Those in front of which, the way they look, there is a voxel of `covering` are covered. Both
/// parts are in the order of `patches`.
SplitPatches split(const std::vector<FacePatch>& patches, const openvdb::MaskTree& covering);

}  // namespace vantage::volume::detail
