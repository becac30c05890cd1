#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scoring/voxel/box_soa.hpp"
#include "vantage/raycore/points.hpp"

namespace vantage::planner::detail {

/// The points' places along a Z-shaped curve through their box, so that neighbours in the order are
/// neighbours in space; among equals as given.
std::vector<std::uint32_t> z_curve_order(PointsView points);

/// Points that lie in one block share a box, and eight blocks that follow each other share one of
/// the next level: 4 packets each of 16 make the lowest.
inline constexpr std::size_t kPacketsPerBlock = 4;
inline constexpr std::size_t kPointsPerBlock = kPacketsPerBlock * kPacketWidth;
inline constexpr std::size_t kBlocksPerParent = kBoxLanes;

/// A set of points for packets of rays: in an order in which neighbours in the list are neighbours
/// in space (along a Z-shaped curve), the last packet filled up with copies of the last point.
struct PointPackets {
  Points points;
  std::vector<std::uint32_t> original;  ///< for each point, where it was in the list given
  std::size_t size = 0;                 ///< points, copies left out

  /// The packets in an order in which any few that follow each other are spread over the whole set.
  std::vector<std::uint32_t> spread;

  /// Boxes of blocks, level by level, the last level with at most one box.
  std::vector<BoxLanes> levels;
  double largest_coordinate = 0;

  explicit PointPackets(const Points& given);

  std::size_t packets() const noexcept { return spread.size(); }
  std::size_t blocks() const noexcept { return levels.front().size; }

  /// Bit l is set unless point l of the packet is a copy.
  std::uint16_t lanes(std::size_t packet) const {
    const std::size_t left = size - packet * kPacketWidth;
    return std::uint16_t(left >= kPacketWidth ? 0xFFFFu : (1u << left) - 1);
  }

  /// Points below one box of a level.
  std::size_t points_below(std::size_t level, std::size_t box) const;
};

}  // namespace vantage::planner::detail
