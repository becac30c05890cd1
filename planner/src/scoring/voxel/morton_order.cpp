#include "scoring/voxel/morton_order.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <utility>

namespace vantage::detail {
namespace {

/// More points than this stay as they are: grids hand them out block by block, which will do where
/// sorting would take seconds.
constexpr std::size_t kMostSorted = std::size_t(1) << 22;

/// Two zero bits between each of the lower 21 bits of `v`.
std::uint64_t with_gaps(std::uint64_t v) {
  v = (v | v << 32) & 0x001F00000000FFFF;
  v = (v | v << 16) & 0x001F0000FF0000FF;
  v = (v | v << 8) & 0x100F00F00F00F00F;
  v = (v | v << 4) & 0x10C30C30C30C30C3;
  v = (v | v << 2) & 0x1249249249249249;
  return v;
}

}  // namespace

std::vector<std::uint32_t> z_curve_order(PointsView points) {
  if (points.size > kMostSorted) {
    std::vector<std::uint32_t> order(points.size);
    std::iota(order.begin(), order.end(), 0u);
    return order;
  }
  Eigen::AlignedBox3d box;
  for (std::size_t i = 0; i < points.size; ++i) box.extend(points[i].cast<double>());
  const double longest = std::max(box.sizes().maxCoeff(), 1e-30);
  const double scale = double((1 << 21) - 1) / longest;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(points.size);
  for (std::size_t i = 0; i < points.size; ++i) {
    const Eigen::Vector3d p = (points[i].cast<double>() - box.min()) * scale;
    keys[i] = {with_gaps(std::uint64_t(p.x())) << 2 | with_gaps(std::uint64_t(p.y())) << 1 |
                   with_gaps(std::uint64_t(p.z())),
               std::uint32_t(i)};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(points.size);
  std::transform(keys.begin(), keys.end(), order.begin(),
                 [](const auto& key) { return key.second; });
  return order;
}

}  // namespace vantage::detail
