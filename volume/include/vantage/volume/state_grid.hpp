#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>

#include "vantage/raycore/export.hpp"
#include "vantage/raycore/points.hpp"
#include "vantage/volume/grid_geometry.hpp"
#include "vantage/volume/volume_options.hpp"
#include "vantage/volume/volume_report.hpp"

namespace vantage {

/// The state of a voxel. The numbers are those of `grid.vdb`.
enum class VoxelState : std::int32_t {
  free = 0,      ///< seen through by at least one camera
  occupied = 1,  ///< inside a known object, or at a measured surface
  shadow = 2,    ///< neither free nor occupied: no camera sees it
  revealed = 3,  ///< shadow that the suggested view would see
};

/// Why a voxel is in shadow. Of several cameras the first of these that holds for one counts.
enum class ShadowCause {
  hidden,      ///< in a camera's view, behind something known or measured
  unmeasured,  ///< in a camera's view, with nothing known in the way, but no reading at its pixel
  outside,     ///< outside every camera's image and depth range
};

namespace volume::detail {
struct StateGridImpl;
}

/// The state of every voxel in the work area: immutable, sparse OpenVDB
/// trees in which free voxels cost nothing. Made by `classify`, shared by `shared_ptr<const
/// StateGrid>`; every method is thread-safe.
class VANTAGE_API StateGrid {
 public:
  explicit StateGrid(std::unique_ptr<const volume::detail::StateGridImpl> impl);
  ~StateGrid();
  StateGrid(const StateGrid&) = delete;
  StateGrid& operator=(const StateGrid&) = delete;

  const GridGeometry& geometry() const noexcept;

  /// Voxels outside the grid are free.
  VoxelState at(const Eigen::Vector3i& voxel) const;

  /// Whether a voxel is occupied because a depth image shows a surface there, and not because it is
  /// inside a known object.
  bool measured(const Eigen::Vector3i& voxel) const;

  /// Why a shadow (or revealed) voxel is in shadow; nothing for the others.
  std::optional<ShadowCause> shadow_cause(const Eigen::Vector3i& voxel) const;

  std::uint64_t count(VoxelState state) const noexcept;
  double volume_m3(VoxelState state) const {
    return double(count(state)) * geometry().voxel_volume_m3();
  }

  const VolumeReport& report() const noexcept;

  /// The centres of all voxels in a state, world frame, block of 8³ by block (in the order of an
  /// OpenVDB tree), in a block x slowest and z fastest: neighbours in the list are neighbours in
  /// space. The order does not depend on how the grid came about.
  Points centres(VoxelState state) const;

  /// This grid with some of its shadow voxels revealed; these keep their cause.
  /// @param seen 1 or 0 for each of `centres(VoxelState::shadow)`, in that order.
  /// @throws Error bad_input for another number of flags.
  std::shared_ptr<const StateGrid> with_revealed(std::span<const std::uint8_t> seen) const;

  /// Writes an OpenVDB file with the int32 grid `state`, and for programs that read no int32 grids
  /// the bool grids `occupied`, `shadow`, `revealed`, `measured`, and by the shadow's cause
  /// `unmeasured` and `unseen` (which is what is outside all images), true and active in their
  /// voxels. The transform of all maps an index to the voxel's centre.
  /// @throws Error as `write_file` does.
  void write_vdb(const std::filesystem::path& path) const;

  /// For this library's own sources.
  const volume::detail::StateGridImpl& impl() const noexcept { return *impl_; }

 private:
  std::unique_ptr<const volume::detail::StateGridImpl> impl_;
};

}  // namespace vantage
