#pragma once

#include <array>
#include <memory>
#include <vector>

#include "reasoning/presence.hpp"

namespace vantage::reconstruction::detail {

/// Snapshots of the past as far as they say where something could be seen: the last one, and ever
/// fewer of those before it, back to 64 snapshots ago.
class History {
 public:
  void add(double time_s, std::span<const CameraView> views, std::span<const DepthCamera> depth,
           std::shared_ptr<const Scene> scene);

  /// Whether an object at this pose should have been seen in them: it was not there yet.
  bool was_seen_empty(const ObjectType& type, const Pose& T_world_object) const;

 private:
  struct Past {
    double time_s = 0;
    std::vector<CameraView> views;  // without observations
    std::vector<DepthCamera> depth;
    std::shared_ptr<const Scene> scene;
    std::unique_ptr<Presence> presence;
  };

  std::array<std::shared_ptr<const Past>, 7> past_;  // [i]: the last whose number divides by 2^i
  std::size_t count_ = 0;
};

}  // namespace vantage::reconstruction::detail
