#include "reference/plain_views.hpp"

#include <algorithm>
#include <numeric>

namespace vantage::test {

std::vector<std::uint8_t> plain_visible(PointsView points, const Scene& occluders,
                                        const PinholeCamera& view) {
  std::vector<std::uint8_t> visible(points.size);
  const Eigen::Vector3f eye = view.centre().cast<float>();
  for (std::size_t i = 0; i < points.size; ++i) {
    visible[i] = view.in_view(points[i]) && !occluders.occluded(points[i], eye);
  }
  return visible;
}

std::vector<std::uint64_t> plain_scores(PointsView points, const Scene& occluders,
                                        std::span<const PinholeCamera> views) {
  std::vector<std::uint64_t> scores;
  for (const PinholeCamera& view : views) {
    const std::vector<std::uint8_t> visible = plain_visible(points, occluders, view);
    scores.push_back(std::accumulate(visible.begin(), visible.end(), std::uint64_t(0)));
  }
  return scores;
}

PlainList::PlainList(PointsView voxels, double voxel_size_m) : half_m_(0.5 * voxel_size_m) {
  for (std::size_t i = 0; i < voxels.size; ++i) centres_.push_back(voxels[i].cast<double>());
}

std::uint64_t PlainList::score(PointsView points, const PinholeCamera& view) const {
  std::uint64_t score = 0;
  for (std::size_t i = 0; i < points.size; ++i) {
    score += view.in_view(points[i]) && seen(points[i].cast<double>(), view.centre());
  }
  return score;
}

/// The slab test, voxel by voxel, until one is met.
bool PlainList::seen(const Eigen::Vector3d& point, const Eigen::Vector3d& eye) const {
  const Eigen::Vector3d inverse = (eye - point).cwiseInverse();
  return std::none_of(centres_.begin(), centres_.end(), [&](const Eigen::Vector3d& centre) {
    const Eigen::Array3d a = (centre - point).array() - half_m_, b = a + 2 * half_m_;
    const Eigen::Array3d s = a * inverse.array(), t = b * inverse.array();
    const double enter = std::max(0.0, s.min(t).maxCoeff());
    return enter <= std::min(1.0, s.max(t).minCoeff());
  });
}

}  // namespace vantage::test
