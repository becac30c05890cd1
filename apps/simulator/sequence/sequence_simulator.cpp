#include "simulator/sequence/sequence_simulator.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "simulator/depth/depth_sensor.hpp"
#include "simulator/scene/resized_camera.hpp"
#include "simulator/scene/sample_hash.hpp"
#include "vantage/raycore/advanced/scene_builder.hpp"
#include "vantage/raycore/error.hpp"

namespace vantage {
namespace {

constexpr std::uint64_t kDepthDraw = 1, kRecallDraw = 2, kCornerDraw = 3;

/// The scenes of one instant: one for each time at which a camera takes its picture.
class ScenesByTime {
 public:
  ScenesByTime(const SequencePlan& plan, std::span<const KnownObject> fixed)
      : plan_(plan), fixed_(fixed) {}

  struct Entry {
    SequenceMoment moment;
    std::shared_ptr<const Scene> scene;
  };
  const Entry& at(double time_s) {
    auto [entry, is_new] = by_time_.try_emplace(time_s);
    if (is_new) {
      entry->second.moment = moment_at(plan_, time_s);
      entry->second.scene = scene_of(plan_, entry->second.moment, fixed_);
    }
    return entry->second;
  }

 private:
  const SequencePlan& plan_;
  std::span<const KnownObject> fixed_;
  std::map<double, Entry> by_time_;
};

Observation observe_marker(const Marker& marker, const MarkerSight& sight, double sigma_px,
                           std::uint64_t hash) {
  SeenPoints seen{{sight.corners_px.begin(), sight.corners_px.end()}, sigma_px};
  for (std::size_t i = 0; i < seen.pixels.size(); ++i) {
    for (int axis = 0; axis < 2; ++axis) {
      seen.pixels[i][axis] += sigma_px * to_normal(sample_hash(hash, i, axis));
    }
  }
  return {marker_key(marker.dictionary, marker.id), std::move(seen)};
}

/// All markers of an object that the detector finds.
/// @param hash of seed, instant, camera and object.
std::vector<Observation> observe_object(const ObjectType& type, const Pose& pose,
                                        const SequenceCamera& camera, const Scene& scene,
                                        double sigma_px, std::uint64_t hash) {
  std::vector<Observation> found;
  const std::vector<Marker> markers = type.markers();
  for (std::size_t m = 0; m < markers.size(); ++m) {
    const auto sight = see_marker(markers[m], pose, camera, scene);
    if (!sight || to_unit(sample_hash(hash, m, kRecallDraw)) >= sight->recall) continue;
    found.push_back(
        observe_marker(markers[m], *sight, sigma_px, sample_hash(hash, m, kCornerDraw)));
  }
  return found;
}

}  // namespace

std::shared_ptr<const Scene> scene_of(const SequencePlan& plan, const SequenceMoment& moment,
                                      std::span<const KnownObject> fixed) {
  SceneBuilder builder;
  for (const KnownObject& object : fixed) {
    builder.add_mesh(object.mesh->transformed(object.T_world_object));
  }
  for (const ObjectAtTime& object : moment.objects) {
    builder.add_mesh(plan.objects[object.object].type->mesh->transformed(object.T_world_object));
  }
  for (const ArmPart& part : moment.arm) {
    builder.add_mesh(part.mesh->transformed(part.T_world_part));
  }
  return builder.build();
}

bool likely_seen(const ObjectType& type, const Pose& T_world_object,
                 std::span<const SequenceCamera> cameras, const Scene& scene) {
  for (const SequenceCamera& camera : cameras) {
    for (const Marker& marker : type.markers()) {
      const auto sight = see_marker(marker, T_world_object, camera, scene);
      if (sight && sight->recall > 0.5) return true;
    }
  }
  return false;
}

SequenceSimulator::SequenceSimulator(SequencePlan plan, std::vector<KnownObject> fixed,
                                     std::vector<SequenceCamera> cameras,
                                     const FeatureSensor& sensor, std::uint64_t seed)
    : plan_(std::move(plan)),
      fixed_(std::move(fixed)),
      cameras_(std::move(cameras)),
      sensor_(sensor),
      seed_(seed) {
  plan_.check();
  sensor_.depth.check("depth");
  if (!(sensor_.sigma_px > 0) || !std::isfinite(sensor_.sigma_px)) {
    throw bad_input("sigma_px", fmt::format("found {}; expected pixels above 0", sensor_.sigma_px));
  }
  if (sensor_.depth_width < 0 || sensor_.depth_width > 16384) {
    throw bad_input("depth_width", fmt::format("found {}; expected 0 to 16384 pixels, 0 for none",
                                               sensor_.depth_width));
  }
}

SimulatedInstant SequenceSimulator::at(int instant) const {
  ScenesByTime scenes(plan_, fixed_);
  SimulatedInstant result;
  result.time_s = plan_.time_s(instant);
  result.truth = moment_at(plan_, result.time_s);
  result.seen.assign(plan_.objects.size(), false);
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    const SequenceCamera& camera = cameras_[c];
    const auto& [moment, scene] = scenes.at(result.time_s + plan_.delay_s(c));
    CameraView view{camera.name, camera.lens, camera.camera.T_world_cam()};
    for (const ObjectAtTime& object : moment.objects) {
      const auto found =
          observe_object(*plan_.objects[object.object].type, object.T_world_object, camera, *scene,
                         sensor_.sigma_px, sample_hash(seed_, instant, c, object.object));
      if (!found.empty()) result.seen[object.object] = true;
      view.observations.insert(view.observations.end(), found.begin(), found.end());
    }
    result.views.push_back(std::move(view));
    if (sensor_.depth_width == 0) continue;
    const Intrinsics& k = camera.camera.intrinsics();
    const int height = std::max(1, sensor_.depth_width * k.height / k.width);
    const PinholeCamera small = resized_camera(camera.camera, sensor_.depth_width, height);
    result.depth.push_back(
        {camera.name, small,
         std::make_shared<const DepthImage>(simulate_depth(
             *scene, small, sensor_.depth, sample_hash(seed_, instant, c, kDepthDraw)))});
  }
  return result;
}

bool SequenceSimulator::would_be_seen(int instant, const ObjectType& type,
                                      const Pose& T_world_object) const {
  ScenesByTime scenes(plan_, fixed_);
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    const auto& entry = scenes.at(plan_.time_s(instant) + plan_.delay_s(c));
    if (likely_seen(type, T_world_object, {&cameras_[c], 1}, *entry.scene)) return true;
  }
  return false;
}

}  // namespace vantage
