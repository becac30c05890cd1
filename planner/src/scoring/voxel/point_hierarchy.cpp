#include "scoring/voxel/point_hierarchy.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

namespace vantage::planner::detail {
namespace {

/// More points than this stay as they are: grids hand them out block by block, which will do where
/// sorting would take seconds.
constexpr std::size_t kMaxSorted = std::size_t(1) << 22;

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
  if (points.size > kMaxSorted) {
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

namespace {

struct Corners {
  Eigen::Vector3d min, max;
};

Corners corners(PointsView points) {
  Corners box{points[0].cast<double>(), points[0].cast<double>()};
  for (std::size_t i = 1; i < points.size; ++i) {
    const Eigen::Vector3d p = points[i].cast<double>();
    box.min = box.min.cwiseMin(p), box.max = box.max.cwiseMax(p);
  }
  return box;
}

/// 0 … count - 1 by their bits read backwards (J. van der Corput, 1935).
std::vector<std::uint32_t> spread_order(std::size_t count) {
  std::vector<std::uint32_t> order;
  order.reserve(count);
  const int bits = std::bit_width(count - 1);
  for (std::size_t i = 0; i < std::size_t(1) << bits; ++i) {
    std::size_t reversed = 0;
    for (int bit = 0; bit < bits; ++bit) reversed |= (i >> bit & 1) << (bits - 1 - bit);
    if (reversed < count) order.push_back(std::uint32_t(reversed));
  }
  return order;
}

BoxLanes block_boxes(PointsView points) {
  BoxLanes boxes((points.size + kPointsPerBlock - 1) / kPointsPerBlock);
  for (std::size_t i = 0; i < boxes.size; ++i) {
    const std::size_t first = i * kPointsPerBlock;
    const std::size_t count = std::min(kPointsPerBlock, points.size - first);
    const Corners box = corners(points.part(first, count));
    boxes.set(i, box.min, box.max);
  }
  return boxes;
}

BoxLanes parent_boxes(const BoxLanes& below) {
  BoxLanes boxes((below.size + kBlocksPerParent - 1) / kBlocksPerParent);
  for (std::size_t parent = 0; parent < boxes.size; ++parent) {
    Corners box{Eigen::Vector3d::Constant(1e300), Eigen::Vector3d::Constant(-1e300)};
    const std::size_t first = parent * kBlocksPerParent;
    for (std::size_t i = first; i < std::min(first + kBlocksPerParent, below.size); ++i) {
      const Eigen::Vector3d centre(below.centre_x[i], below.centre_y[i], below.centre_z[i]);
      const Eigen::Vector3d half(below.half_x[i], below.half_y[i], below.half_z[i]);
      box.min = box.min.cwiseMin(centre - half), box.max = box.max.cwiseMax(centre + half);
    }
    boxes.set(parent, box.min, box.max);
  }
  return boxes;
}

}  // namespace

PointPackets::PointPackets(const Points& given) : size(given.size()) {
  if (size == 0) return;
  original = z_curve_order(given);
  const std::size_t packet_count = (size + kPacketWidth - 1) / kPacketWidth;
  points.resize(packet_count * kPacketWidth);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points.set(i, given[original[std::min(i, size - 1)]]);
  }
  spread = spread_order(packet_count);
  levels.push_back(block_boxes(points));
  while (levels.back().size > 1) levels.push_back(parent_boxes(levels.back()));
  const Corners box = corners(points);
  largest_coordinate = std::max(box.min.cwiseAbs().maxCoeff(), box.max.cwiseAbs().maxCoeff());
}

std::size_t PointPackets::points_below(std::size_t level, std::size_t box) const {
  std::size_t each = kPointsPerBlock;
  for (std::size_t i = 0; i < level; ++i) each *= kBlocksPerParent;
  return std::min(each, size - box * each);
}

}  // namespace vantage::planner::detail
