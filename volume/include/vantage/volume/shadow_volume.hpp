#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "vantage/raycore/depth_image.hpp"
#include "vantage/raycore/export.hpp"
#include "vantage/raycore/stop_token.hpp"
#include "vantage/raycore/world_model.hpp"
#include "vantage/volume/grid_geometry.hpp"
#include "vantage/volume/state_grid.hpp"
#include "vantage/volume/volume_options.hpp"

namespace vantage {

/// The work area as several cameras see it, kept up to date change by change.
///
/// What is inside the known objects, what each camera sees past them, and what its depth image adds
/// are kept apart, so that a change costs only what it affects:
/// - a new depth image one camera's comparison of depths, and no ray;
/// - a camera that comes or moves its own rays, one that goes none;
/// - objects that come, go or move their voxels, and the rays that may meet them where they were or
///   are. `grid()` decides again only the parts of the work area whose evidence has changed. It is
///   bit for bit what a new ShadowVolume of the same world gives.
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

  /// Cameras have numbers from 0 on: first those of the world model, in its order.
  std::size_t camera_count() const noexcept;

  /// Adds a camera after all others.
  /// @returns its number.
  /// @throws Error bad_input if the image does not fit the camera; nothing has changed then.
  std::size_t add_camera(const DepthCamera& camera, const StopToken& stop = {});

  /// Takes a camera away, and all that it alone saw with it. Those after it move up by one.
  /// @throws Error bad_input for a number out of range; nothing has changed then.
  void remove_camera(std::size_t camera);

  /// Replaces what camera `camera` measured; null for nothing.
  /// @throws Error bad_input for a number out of range, or if the image does not fit the camera;
  /// nothing has changed then.
  void set_depth(std::size_t camera, std::shared_ptr<const DepthImage> depth,
                 const StopToken& stop = {});

  /// The camera moved, and measured `depth` there.
  /// @throws Error as `set_depth` does.
  void move_camera(std::size_t camera, const Pose& T_world_cam,
                   std::shared_ptr<const DepthImage> depth, const StopToken& stop = {});

  /// Replaces the known objects; static structures stay. One with the same mesh (the same pointer)
  /// at the same pose has not changed.
  /// @throws Error bad_input for an object without a mesh; nothing has changed then.
  void set_objects(std::vector<KnownObject> objects, const StopToken& stop = {});

  /// The state of every voxel now; null while something that was stopped has not been done again:
  /// for a camera's depth `set_depth`, for a camera `move_camera` (or it is removed), for objects
  /// `set_objects`, for the construction a new volume. If nothing has changed, the same grid again.
  std::shared_ptr<const StateGrid> grid() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace vantage
