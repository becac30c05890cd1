#include "tracking/occluders.hpp"

#include <algorithm>

#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/detail/mesh_measures.hpp"

namespace vantage::reconstruction::detail {
namespace {

/// Poses that differ by less hide the same: rays start that far in front of a surface.
bool is_same_place(const Pose& a, const Pose& b) {
  constexpr double kNotable_m = 1e-3, kNotable_rad = 1e-2;
  return (a.translation() - b.translation()).norm() < kNotable_m &&
         rotation_vector(a.rotation() * b.rotation().transpose()).norm() < kNotable_rad;
}

bool holds_a_camera(const KnownObject& solid, std::span<const CameraView> views) {
  const Eigen::AlignedBox3d bounds = raycore::detail::bounds_of(*solid.mesh);
  return std::ranges::any_of(views, [&](const CameraView& view) {
    return view.T_world_cam &&
           bounds.contains(solid.T_world_object.inverse() * view.T_world_cam->translation());
  });
}

}  // namespace

std::vector<Occluders::Instance> Occluders::instances(std::span<const Track> tracks,
                                                      std::span<const CameraView> views) const {
  std::vector<Instance> result;
  for (const KnownObject& solid : solids_) {
    if (!holds_a_camera(solid, views)) result.emplace_back(solid.mesh, solid.T_world_object);
  }
  for (const Track& track : tracks) {
    if (!track.confirmed() || track.gone || track.existence() < 0.5) continue;
    result.emplace_back(track.type->mesh, track.place.filter.pose());
  }
  return result;
}

std::shared_ptr<const Scene> Occluders::update(std::span<const Track> tracks,
                                               std::span<const CameraView> views) {
  std::vector<Instance> now = instances(tracks, views);
  const bool same = scene_ && std::ranges::equal(now, built_, [](const auto& a, const auto& b) {
                      return a.first == b.first && is_same_place(a.second, b.second);
                    });
  if (same) return scene_;
  SceneBuilder builder;
  for (const auto& [mesh, pose] : now) builder.add_instance(mesh, pose);
  scene_ = builder.build();
  built_ = std::move(now);
  return scene_;
}

}  // namespace vantage::reconstruction::detail
