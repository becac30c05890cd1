#include "vantage/volume/grid_geometry.hpp"

#include <fmt/format.h>

#include <cmath>

#include "vantage/raycore/error.hpp"

namespace vantage {

GridGeometry GridGeometry::covering(const Box& work_area, double voxel_size_m) {
  if (!(std::isfinite(voxel_size_m) && voxel_size_m > 0)) {
    throw bad_input("voxel size",
                    fmt::format("it is {} m; expected a number above 0", voxel_size_m));
  }
  // A last centre that is on the border but for rounding is inside.
  const Eigen::Array3d counts =
      (work_area.size().array() / voxel_size_m + (0.5 + 1e-9)).floor().max(1.0);
  if (!(counts.prod() <= kMaxVoxels)) {
    throw Error(ErrorCode::out_of_resources, "voxel size",
                fmt::format("{} m gives {:.3g} voxels in the work area of {:.3g} m³; the limit is "
                            "{:.3g}: use {:.2g} m or more, or a smaller work area",
                            voxel_size_m, counts.prod(), work_area.volume_m3(), kMaxVoxels,
                            std::cbrt(work_area.volume_m3() / kMaxVoxels) * 1.05));
  }
  return {work_area.min(), voxel_size_m, counts.cast<int>().matrix()};
}

std::uint64_t GridGeometry::voxel_count() const {
  return std::uint64_t(size_.x()) * std::uint64_t(size_.y()) * std::uint64_t(size_.z());
}

std::optional<Eigen::Vector3i> GridGeometry::voxel_at(const Eigen::Vector3d& p_world) const {
  const Eigen::Array3d index = ((p_world - origin_) / voxel_size_m_).array().floor();
  const bool inside = (index >= 0).all() && (index < size_.array().cast<double>()).all();
  if (!inside) return std::nullopt;  // NaN ends here too
  return index.cast<int>().matrix();
}

}  // namespace vantage
