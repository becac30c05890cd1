#include "reference/plain_regions.hpp"

#include <algorithm>
#include <deque>
#include <numeric>

namespace vantage::test {
namespace {

class Search {
 public:
  Search(const StateGrid& grid, std::vector<std::int32_t>& labels) : grid_(grid), labels_(labels) {}

  std::int32_t& label(const Eigen::Vector3i& v) {
    const Eigen::Vector3i n = grid_.geometry().size();
    return labels_[(std::size_t(v.x()) * std::size_t(n.y()) + std::size_t(v.y())) *
                       std::size_t(n.z()) +
                   std::size_t(v.z())];
  }
  bool is_new_shadow(const Eigen::Vector3i& v) {
    return grid_.geometry().contains(v) && grid_.at(v) == VoxelState::shadow && label(v) == 0;
  }

  ShadowRegion from(const Eigen::Vector3i& start, std::int32_t number) {
    ShadowRegion region{0, 0, 0, start, start, start, Eigen::Vector3d::Zero()};
    std::deque<Eigen::Vector3i> front{start};
    label(start) = number;
    while (!front.empty()) {
      const Eigen::Vector3i voxel = front.front();
      front.pop_front();
      ++region.voxels;
      region.unmeasured_voxels += grid_.shadow_cause(voxel) == ShadowCause::unmeasured;
      region.outside_voxels += grid_.shadow_cause(voxel) == ShadowCause::outside;
      region.min_voxel = region.min_voxel.cwiseMin(voxel);
      region.max_voxel = region.max_voxel.cwiseMax(voxel);
      region.centroid_m += grid_.geometry().centre(voxel);
      for (int axis = 0; axis < 3; ++axis) {
        for (const int step : {-1, 1}) {
          const Eigen::Vector3i next = voxel + step * Eigen::Vector3i::Unit(axis);
          if (!is_new_shadow(next)) continue;
          label(next) = number;
          front.push_back(next);
        }
      }
    }
    region.centroid_m /= double(region.voxels);
    return region;
  }

 private:
  const StateGrid& grid_;
  std::vector<std::int32_t>& labels_;
};

}  // namespace

PlainRegions::PlainRegions(const StateGrid& grid) : labels(grid.geometry().voxel_count()) {
  Search search(grid, labels);
  const Eigen::Vector3i n = grid.geometry().size();
  for (int i = 0; i < n.x(); ++i)
    for (int j = 0; j < n.y(); ++j)
      for (int k = 0; k < n.z(); ++k) {
        const Eigen::Vector3i voxel(i, j, k);
        if (!search.is_new_shadow(voxel)) continue;
        list.push_back(search.from(voxel, std::int32_t(list.size() + 1)));
      }
  // Found in the order of their first voxels, which a stable sort keeps among equals.
  std::vector<std::int32_t> order(list.size()), rank(list.size() + 1);
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return list[std::size_t(a)].voxels > list[std::size_t(b)].voxels;
  });
  std::vector<ShadowRegion> sorted;
  for (const std::int32_t found : order) {
    sorted.push_back(list[std::size_t(found)]);
    rank[std::size_t(found) + 1] = std::int32_t(sorted.size());
  }
  list = std::move(sorted);
  for (std::int32_t& label : labels) label = rank[std::size_t(label)];
}

}  // namespace vantage::test
