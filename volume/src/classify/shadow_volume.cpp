#include "vantage/volume/shadow_volume.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "classify/camera_visibility.hpp"
#include "classify/depth_integration.hpp"
#include "classify/fuse_cameras.hpp"
#include "objects/float_resolution.hpp"
#include "objects/known_objects.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

using volume::detail::CameraEvidence;
using volume::detail::CameraVisibility;
using volume::detail::DepthEvidence;
using volume::detail::KnownObjects;

void check_depth(const PinholeCamera& camera, const std::shared_ptr<const DepthImage>& depth,
                 const std::string& name) {
  if (depth != nullptr) PosedDepth(camera, depth, "camera " + name);
}

const WorldModel& checked(const WorldModel& world, const GridGeometry& geometry,
                          const VolumeOptions& options) {
  options.check();
  volume::detail::check_meshes(world);
  volume::detail::check_float_resolution(world, geometry);
  for (const DepthCamera& camera : world.cameras) {
    check_depth(camera.camera, camera.depth, camera.name);
  }
  return world;
}

/// Of more, asking for each what it may hide takes as long as tracing.
constexpr std::size_t kMaxChangedExtents = 64;

/// One camera, and how much of its evidence is there.
struct Camera {
  std::string name;
  CameraEvidence evidence;
  bool in_view = false;   ///< `covered` is complete
  bool traced = false;    ///< `clear` is
  bool measured = false;  ///< `depth` is
};

}  // namespace

struct ShadowVolume::Impl {
  GridGeometry geometry;
  VolumeOptions options;
  Pose T_grid_world;
  volume::detail::GridFrame frame;
  std::vector<KnownObject> structures;
  std::shared_ptr<const KnownObjects> known;
  bool known_complete;
  std::shared_ptr<const KnownObjects> hiding;  ///< what the occluders are made of
  std::unique_ptr<const volume::detail::Occluders> occluders;
  std::vector<Camera> cameras;
  volume::detail::Fusion fusion;

  Impl(const WorldModel& world, const GridGeometry& g, const VolumeOptions& o,
       const StopToken& stop)
      : geometry(g),
        options(o),
        T_grid_world(Pose::from_translation(-g.origin())),
        frame(g),
        structures(checked(world, g, o).static_structures),
        known(std::make_shared<const KnownObjects>(world, frame, T_grid_world, stop)),
        known_complete(!stop.stop_requested()),
        fusion(g) {
    make_occluders();
  }

  void make_occluders() {
    hiding = known;
    occluders = options.occluders == OccluderMode::mesh
                    ? volume::detail::mesh_occluders(hiding->meshes)
                    : volume::detail::voxel_occluders(hiding->solid, frame.voxel_size_m);
  }

  volume::detail::KnownSpace space() const {
    return {frame, known->solid, known->surface_octants, *occluders};
  }

  CameraEvidence evidence_at(const PinholeCamera& camera, const Pose& T_world_cam) const {
    return {camera.moved_to(T_grid_world * T_world_cam), frame.layout};
  }

  void trace(Camera& camera, const StopToken& stop) {
    camera.evidence.sight = volume::detail::trace_sight(camera.evidence.camera, space(), stop);
    camera.in_view = !stop.stop_requested();
    camera.traced = camera.in_view && known_complete;
  }

  void measure(Camera& camera, const DepthImage* depth, const StopToken& stop) {
    CameraEvidence& evidence = camera.evidence;
    evidence.depth.reset();
    if (depth != nullptr) {
      evidence.depth = volume::detail::compare_with_depth(evidence.camera, *depth, frame,
                                                          evidence.sight.covered, options, stop);
    }
    camera.measured = camera.in_view && !stop.stop_requested();
  }

  /// Traces what may have changed, or all if that was not complete.
  void trace_again(Camera& camera, std::span<const Extent> changed, const StopToken& stop) {
    if (camera.traced && changed.empty()) return;
    CameraVisibility& sight = camera.evidence.sight;
    const CameraVisibility before = sight;
    if (!camera.traced || changed.size() > kMaxChangedExtents) {
      const bool in_view = camera.in_view;
      trace(camera, stop);
      camera.in_view = camera.in_view || in_view;
      if (stop.stop_requested() && in_view) sight.covered = before.covered;
    } else {
      volume::detail::retrace_sight(camera.evidence.camera, space(), changed, stop, sight);
      camera.traced = !stop.stop_requested();
    }
    fusion.changed(&before, &sight);
  }

  Camera& camera_at(std::size_t index) {
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
  for (const DepthCamera& observer : world.cameras) add_camera(observer, stop);
}

ShadowVolume::~ShadowVolume() = default;

std::size_t ShadowVolume::camera_count() const noexcept {
  return impl_->cameras.size();
}

std::size_t ShadowVolume::add_camera(const DepthCamera& camera, const StopToken& stop) {
  check_depth(camera.camera, camera.depth, camera.name);
  Camera added{camera.name, impl_->evidence_at(camera.camera, camera.camera.T_world_cam())};
  if (!stop.stop_requested()) {
    impl_->trace(added, stop);
    impl_->measure(added, camera.depth.get(), stop);
  }
  impl_->fusion.changed(nullptr, &added.evidence);
  impl_->cameras.push_back(std::move(added));
  return impl_->cameras.size() - 1;
}

void ShadowVolume::remove_camera(std::size_t camera) {
  const CameraEvidence& evidence = impl_->camera_at(camera).evidence;
  impl_->fusion.changed(&evidence, nullptr);
  impl_->cameras.erase(impl_->cameras.begin() + std::ptrdiff_t(camera));
}

void ShadowVolume::set_depth(std::size_t camera, std::shared_ptr<const DepthImage> depth,
                             const StopToken& stop) {
  Camera& changed = impl_->camera_at(camera);
  check_depth(changed.evidence.camera, depth, changed.name);
  const std::optional<DepthEvidence> before = std::move(changed.evidence.depth);
  impl_->measure(changed, depth.get(), stop);
  const std::optional<DepthEvidence>& after = changed.evidence.depth;
  impl_->fusion.changed(before ? &*before : nullptr, after ? &*after : nullptr,
                        changed.evidence.sight);
}

void ShadowVolume::move_camera(std::size_t camera, const Pose& T_world_cam,
                               std::shared_ptr<const DepthImage> depth, const StopToken& stop) {
  Camera& moved = impl_->camera_at(camera);
  check_depth(moved.evidence.camera, depth, moved.name);
  const CameraEvidence before =
      std::exchange(moved.evidence, impl_->evidence_at(moved.evidence.camera, T_world_cam));
  impl_->trace(moved, stop);
  impl_->measure(moved, depth.get(), stop);
  impl_->fusion.changed(&before, &moved.evidence);
}

void ShadowVolume::set_objects(std::vector<KnownObject> objects, const StopToken& stop) {
  const WorldModel world{std::move(objects), impl_->structures, {}};
  volume::detail::check_meshes(world);
  volume::detail::check_float_resolution(world, impl_->geometry);
  const bool complete_before = impl_->known_complete;
  const auto before = impl_->known;
  impl_->known = std::make_shared<const KnownObjects>(
      world, impl_->frame, impl_->T_grid_world, stop, complete_before ? before.get() : nullptr);
  impl_->known_complete = !stop.stop_requested();
  impl_->fusion.changed(*before, *impl_->known);
  const bool comparable = complete_before && impl_->known_complete;
  std::vector<Extent> changed;
  if (comparable) changed = volume::detail::changed_extents(*before, *impl_->known);
  if (!comparable || !changed.empty()) impl_->make_occluders();
  for (Camera& camera : impl_->cameras) {
    camera.traced = camera.traced && comparable;
    if (impl_->known_complete) impl_->trace_again(camera, changed, stop);
  }
}

std::shared_ptr<const StateGrid> ShadowVolume::grid() const {
  bool complete = impl_->known_complete;
  std::vector<const CameraEvidence*> cameras;
  for (const Camera& camera : impl_->cameras) {
    complete = complete && camera.traced && camera.measured;
    cameras.push_back(&camera.evidence);
  }
  if (!complete) return nullptr;
  return impl_->fusion.grid(*impl_->known, cameras, impl_->options.anti_aliased());
}

}  // namespace vantage
