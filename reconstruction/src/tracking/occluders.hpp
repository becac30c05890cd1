#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "tracking/track.hpp"

namespace vantage::reconstruction::detail {

/// What is known to hide objects: static structures, and the tracked objects themselves. Built
/// again only where something moved.
class Occluders {
 public:
  explicit Occluders(std::vector<KnownObject> solids) : solids_(std::move(solids)) {}

  /// Solids that a camera looks out of (a room, its own housing) hide nothing.
  std::shared_ptr<const Scene> update(std::span<const Track> tracks,
                                      std::span<const CameraView> views);

 private:
  using Instance = std::pair<std::shared_ptr<const TriangleMesh>, Pose>;

  std::vector<Instance> instances(std::span<const Track> tracks,
                                  std::span<const CameraView> views) const;

  std::vector<KnownObject> solids_;
  std::vector<Instance> built_;
  std::shared_ptr<const Scene> scene_;
};

}  // namespace vantage::reconstruction::detail
