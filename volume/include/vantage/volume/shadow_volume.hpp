#pragma once

#include <cstddef>
#include <memory>

#include "vantage/raycore/depth_image.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/grid_geometry.hpp"
#include "vantage/volume/state_grid.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

/// The work area as several cameras see it, kept up to date depth image by depth image.
///
/// What each camera sees past the known objects, and what its depth image adds, are kept apart, so
/// that a new depth image costs one camera's comparison of depths and no ray at all. `grid()` is
/// bit for bit what a new ShadowVolume of the same world gives.
///
/// One thread at a time may call a ShadowVolume; work is split over the caller's task arena. The
/// grids that it hands out are immutable and independent of it.
class VANTAGE_API ShadowVolume {
 public:
  /// Voxelises the known objects and traces every camera's rays. `stop` may stop that; it is not
  /// kept for later.
  /// @throws Error bad_input as `classify` does.
  ShadowVolume(const WorldModel& world, const GridGeometry& geometry,
               const VolumeOptions& options = {}, const StopToken& stop = {});
  ~ShadowVolume();
  ShadowVolume(const ShadowVolume&) = delete;
  ShadowVolume& operator=(const ShadowVolume&) = delete;

  /// Replaces what camera `camera` (its index in the world model) measured; null for nothing.
  /// @throws Error bad_input for an index out of range, or if the image does not fit the camera;
  /// nothing has changed then.
  void set_depth(std::size_t camera, std::shared_ptr<const DepthImage> depth,
                 const StopToken& stop = {});

  /// The camera moved, and measured `depth` there.
  /// @throws Error as `set_depth` does.
  void move_camera(std::size_t camera, const Pose& T_world_cam,
                   std::shared_ptr<const DepthImage> depth, const StopToken& stop = {});

  /// The state of every voxel now; null while something that was stopped has not been done again:
  /// for a camera `set_depth` or `move_camera`, for the construction a new volume.
  std::shared_ptr<const StateGrid> grid() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vantage
