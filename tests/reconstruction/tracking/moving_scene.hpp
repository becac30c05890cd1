#pragma once

#include <memory>
#include <string>
#include <vector>

#include "reconstruction/synthetic_views.hpp"
#include "vantage/raycore/solids.hpp"
#include "vantage/reconstruction/tracking.hpp"

namespace vantage::test {

/// Boxes on a table, seen by cameras that stay where they are, ten times a second.
struct MovingScene {
  explicit MovingScene(std::uint32_t seed, int camera_count = 3, int types = 2) : random(seed) {
    cameras = cameras_around(random, camera_count);
    std::vector<ObjectType> all;
    for (int t = 0; t < types; ++t) {
      all.push_back(marked_box("box " + std::to_string(t), {0.08, 0.07, 0.06}, 10 * t));
    }
    knowledge = std::make_shared<MemoryKnowledgeBase>(std::move(all));
  }

  ObjectTracker tracker(const TrackOptions& options = {}) const {
    return ObjectTracker(knowledge, {}, options);
  }

  /// One more picture of every camera.
  TrackedScene see(ObjectTracker& tracker) {
    std::vector<CameraView> views = cameras;
    look_at(views, objects, noise, random);
    time_s += 0.1;
    return tracker.update({time_s, views});
  }

  PlacedObject at(int type, double x, double y, double turn = 0) const {
    return {knowledge->types()[std::size_t(type)],
            Pose::from_rotation(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()).matrix(),
                                {x, y, 0.03})};
  }

  Random random;
  std::vector<CameraView> cameras;
  std::shared_ptr<const MemoryKnowledgeBase> knowledge;
  std::vector<PlacedObject> objects;
  ViewNoise noise = {.sigma_px = 0.2};
  double time_s = 0;
};

/// The object with this id; null if there is none.
inline const TrackedObject* find(const TrackedScene& scene, TrackId id) {
  for (const TrackedObject& object : scene.objects) {
    if (object.id == id) return &object;
  }
  return nullptr;
}

/// The object within a centimetre of a place; null if there is none that is likely there.
inline const TrackedObject* find_at(const TrackedScene& scene, const Pose& T_world_object) {
  for (const TrackedObject& object : scene.objects) {
    const double off = (object.T_world_object.translation() - T_world_object.translation()).norm();
    if (object.existence > 0.5 && off < 0.01) return &object;
  }
  return nullptr;
}

}  // namespace vantage::test
