#include "reference/plain_views.hpp"

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

}  // namespace vantage::test
