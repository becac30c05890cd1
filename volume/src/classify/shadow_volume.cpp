#include "vantage/volume/shadow_volume.hpp"

#include <fmt/format.h>

#include <optional>

#include "classify/camera_visibility.hpp"
#include "classify/depth_integration.hpp"
#include "classify/fuse_cameras.hpp"
#include "objects/known_objects.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

void check(const WorldModel& world) {
  volume::detail::check_meshes(world);
  for (const DepthCamera& camera : world.cameras) {
    if (camera.depth != nullptr) PosedDepth(camera.camera, camera.depth, "camera " + camera.name);
  }
}

const WorldModel& checked(const WorldModel& world, const VolumeOptions& options) {
  options.check();
  check(world);
  return world;
}

}  // namespace

struct ShadowVolume::Impl {
  GridGeometry geometry;
  VolumeOptions options;
  Pose T_grid_world;
  volume::detail::GridFrame frame;
  volume::detail::KnownObjects known;
  bool known_complete;
  std::unique_ptr<const volume::detail::Occluders> occluders;
  std::vector<std::string> names;  ///< of the cameras
  std::vector<volume::detail::CameraEvidence> cameras;

  Impl(const WorldModel& world, const GridGeometry& g, const VolumeOptions& o,
       const StopToken& stop)
      : geometry(g),
        options(o),
        T_grid_world(Pose::from_translation(-g.origin())),
        frame(g),
        known(checked(world, o), frame, T_grid_world, stop),
        known_complete(!stop.stop_requested()),
        occluders(o.occluders == OccluderMode::mesh
                      ? volume::detail::mesh_occluders(known.meshes)
                      : volume::detail::voxel_occluders(known.solid, frame.voxel_size_m)) {}

  void trace(volume::detail::CameraEvidence& camera, const StopToken& stop) {
    camera.sight = volume::detail::trace_sight(
        camera.camera, {frame, known.solid, known.surface_octants, *occluders}, stop);
    camera.traced = !stop.stop_requested();
  }

  void measure(volume::detail::CameraEvidence& camera, const DepthImage* depth,
               const StopToken& stop) {
    camera.depth.reset();
    if (depth != nullptr) {
      camera.depth = volume::detail::compare_with_depth(camera.camera, *depth, frame,
                                                        camera.sight.covered, options, stop);
    }
    camera.measured = !stop.stop_requested();
  }

  volume::detail::CameraEvidence& camera_at(std::size_t index) {
    if (index < cameras.size()) return cameras[index];
    throw bad_input("camera index",
                    fmt::format("{} of a world with {} cameras", index, cameras.size()));
  }
};

ShadowVolume::ShadowVolume(const WorldModel& world, const GridGeometry& geometry,
                           const VolumeOptions& options, const StopToken& stop)
    : impl_(std::make_unique<Impl>(world, geometry, options, stop)) {
  std::size_t steps = 0;
  for (const DepthCamera& observer : world.cameras) steps += observer.depth != nullptr ? 2 : 1;
  stop.expect(steps * impl_->frame.layout.chunk_count());
  for (const DepthCamera& observer : world.cameras) {
    const PinholeCamera camera =
        observer.camera.moved_to(impl_->T_grid_world * observer.camera.T_world_cam());
    impl_->names.push_back(observer.name);
    impl_->cameras.emplace_back(camera, impl_->frame.layout);
    if (stop.stop_requested()) continue;
    impl_->trace(impl_->cameras.back(), stop);
    impl_->measure(impl_->cameras.back(), observer.depth.get(), stop);
  }
}

ShadowVolume::~ShadowVolume() = default;

void ShadowVolume::set_depth(std::size_t camera, std::shared_ptr<const DepthImage> depth,
                             const StopToken& stop) {
  volume::detail::CameraEvidence& evidence = impl_->camera_at(camera);
  if (depth != nullptr) PosedDepth(evidence.camera, depth, "camera " + impl_->names[camera]);
  impl_->measure(evidence, depth.get(), stop);
}

void ShadowVolume::move_camera(std::size_t camera, const Pose& T_world_cam,
                               std::shared_ptr<const DepthImage> depth, const StopToken& stop) {
  volume::detail::CameraEvidence& evidence = impl_->camera_at(camera);
  if (depth != nullptr) PosedDepth(evidence.camera, depth, "camera " + impl_->names[camera]);
  evidence.camera = evidence.camera.moved_to(impl_->T_grid_world * T_world_cam);
  impl_->trace(evidence, stop);
  impl_->measure(evidence, depth.get(), stop);
}

std::shared_ptr<const StateGrid> ShadowVolume::grid() const {
  bool complete = impl_->known_complete;
  for (const volume::detail::CameraEvidence& camera : impl_->cameras) {
    complete = complete && camera.traced && camera.measured;
  }
  if (!complete) return nullptr;
  return volume::detail::combine(impl_->geometry, impl_->known, impl_->cameras,
                                 impl_->options.anti_aliased());
}

}  // namespace vantage
