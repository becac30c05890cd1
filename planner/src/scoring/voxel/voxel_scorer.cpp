#include "vantage/planner/advanced/voxel_scorer.hpp"

#include "scoring/voxel/shadow_points.hpp"

namespace vantage {

VoxelScorer::VoxelScorer(const PlanningScene& scene)
    : voxel_volume_m3_(scene.grid().geometry().voxel_volume_m3()),
      points_(planner::detail::shadow_points(scene), planner::detail::shared_occluders(scene)) {}

Score VoxelScorer::upper_bound(const PinholeCamera& view) const {
  return points_.upper_bound(view);
}

void VoxelScorer::score(std::span<const PinholeCamera> views, std::span<const Score> needed,
                        std::span<ScoreBound> results, const StopToken& stop) const {
  points_.count(views, needed, results, stop);
}

std::vector<ScoreTerm> VoxelScorer::terms(const PinholeCamera& view) const {
  const std::uint64_t in_view = points_.count_in_view(view), revealed = score(view).score;
  return {{"voxels out of view", double(points_.size() - in_view)},
          {"voxels in view", double(in_view)},
          {"voxels hidden by something occupied", double(in_view - revealed)},
          {"voxels revealed", double(revealed)},
          {"volume revealed", double(revealed) * voxel_volume_m3_, "m³"}};
}

std::vector<std::uint8_t> VoxelScorer::revealed(const PinholeCamera& view) const {
  return points_.visible(view);
}

}  // namespace vantage
