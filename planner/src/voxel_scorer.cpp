#include "vantage/planner/voxel_scorer.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <span>

namespace vantage {
namespace {

// Large enough to fill packets after the field-of-view test, small enough to stop within a
// millisecond and to stay in the first caches.
constexpr std::size_t kBlockPoints = 4096;

std::size_t block_count(std::size_t points) {
  return (points + kBlockPoints - 1) / kBlockPoints;
}

/// Marks in `seen` the points that a camera sees, and counts them.
std::uint64_t see_block(const PinholeCamera& camera, const Scene& occluders, PointsView points,
                        std::span<std::uint8_t> seen) {
  camera.in_view(points, seen);
  Points in_view;
  in_view.reserve(points.size);
  for (std::size_t i = 0; i < points.size; ++i) {
    if (seen[i] != 0) in_view.push_back(points[i]);
  }
  std::vector<std::uint8_t> hidden(in_view.size());
  occluders.occluded(in_view, camera.centre().cast<float>(), hidden);
  std::uint64_t count = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < points.size; ++i) {
    if (seen[i] == 0) continue;
    seen[i] = std::uint8_t(1 - hidden[next++]);
    count += seen[i];
  }
  return count;
}

}  // namespace

VoxelScorer::VoxelScorer(const StateGrid& grid, std::shared_ptr<const Scene> occluders)
    : shadow_(grid.centres(VoxelState::shadow)), occluders_(std::move(occluders)) {}

std::optional<std::uint64_t> VoxelScorer::count_revealed(const PinholeCamera& camera,
                                                         const StopToken& stop) const {
  std::atomic<std::uint64_t> count{0};
  std::atomic<bool> stopped{false};
  tbb::parallel_for(std::size_t(0), block_count(shadow_.size()), [&](std::size_t block) {
    if (stop.stop_requested()) {
      stopped.store(true);
      return;
    }
    const std::size_t first = block * kBlockPoints;
    const std::size_t size = std::min(kBlockPoints, shadow_.size() - first);
    std::vector<std::uint8_t> seen(size);
    count += see_block(camera, *occluders_, shadow_.view().part(first, size), seen);
  });
  if (stopped.load()) return std::nullopt;
  return count.load();
}

std::vector<std::uint8_t> VoxelScorer::revealed(const PinholeCamera& camera) const {
  std::vector<std::uint8_t> seen(shadow_.size());
  tbb::parallel_for(std::size_t(0), block_count(shadow_.size()), [&](std::size_t block) {
    const std::size_t first = block * kBlockPoints;
    const std::size_t size = std::min(kBlockPoints, shadow_.size() - first);
    see_block(camera, *occluders_, shadow_.view().part(first, size),
              std::span(seen).subspan(first, size));
  });
  return seen;
}

}  // namespace vantage
