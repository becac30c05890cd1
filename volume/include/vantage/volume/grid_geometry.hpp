#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "vantage/raycore/box.hpp"
#include "vantage/raycore/export.hpp"

namespace vantage {

/// Where the voxels of a grid lie in the world: the one place that converts between the two.
///
/// Voxel (i, j, k) spans [i, i+1) × [j, j+1) × [k, k+1) voxel sizes from `origin()` and is sampled
/// at its centre. World frame, metres. Immutable value type.
class VANTAGE_API GridGeometry {
 public:
  static constexpr double kMaxVoxels = 1 << 30;

  /// The voxels whose centres lie in `work_area`, the first one in its lower corner; at least one
  /// along each axis.
  /// @throws Error bad_input unless `voxel_size_m` is finite and positive; out_of_resources for
  /// more than `kMaxVoxels`, with the smallest size that fits.
  static GridGeometry covering(const Box& work_area, double voxel_size_m);

  const Eigen::Vector3d& origin() const noexcept { return origin_; }
  double voxel_size_m() const noexcept { return voxel_size_m_; }
  double voxel_volume_m3() const { return voxel_size_m_ * voxel_size_m_ * voxel_size_m_; }

  /// Voxels along each axis.
  const Eigen::Vector3i& size() const noexcept { return size_; }
  std::uint64_t voxel_count() const;
  double volume_m3() const { return double(voxel_count()) * voxel_volume_m3(); }
  Box box() const { return Box(corner({0, 0, 0}), corner(size_), "grid"); }

  bool contains(const Eigen::Vector3i& voxel) const {
    return (voxel.array() >= 0).all() && (voxel.array() < size_.array()).all();
  }

  /// The world position of index coordinates; voxel corners are at integers.
  Eigen::Vector3d corner(const Eigen::Vector3i& voxel) const {
    return origin_ + voxel_size_m_ * voxel.cast<double>();
  }
  Eigen::Vector3d centre(const Eigen::Vector3i& voxel) const {
    return origin_ + voxel_size_m_ * (voxel.cast<double>() + Eigen::Vector3d::Constant(0.5));
  }

  /// The voxel that holds a point, if it lies in the grid.
  std::optional<Eigen::Vector3i> voxel_at(const Eigen::Vector3d& p_world) const;

  bool operator==(const GridGeometry&) const = default;

 private:
  GridGeometry(const Eigen::Vector3d& origin, double voxel_size_m, const Eigen::Vector3i& size)
      : origin_(origin), voxel_size_m_(voxel_size_m), size_(size) {}

  Eigen::Vector3d origin_;
  double voxel_size_m_;
  Eigen::Vector3i size_;
};

}  // namespace vantage
