#include "objects/voxel_boxes.hpp"

namespace vantage::detail {
namespace {

/// Takes the voxels of one box out of `left`, starting at its lowest one.
CellRange take_box(BlockBits& left) {
  const Eigen::Vector3i first = voxel_in_block(left.first());
  const auto row = [&](int x, int y) {
    return unsigned(left.words[std::size_t(x)] >> (8 * y)) & 0xFFu;
  };
  int z = first.z();
  while (z < kBlockSide && (row(first.x(), first.y()) >> z & 1u) != 0) ++z;
  const unsigned run = ((1u << z) - 1u) & ~((1u << first.z()) - 1u);

  int y = first.y();
  while (y < kBlockSide && (row(first.x(), y) & run) == run) ++y;
  std::uint64_t sheet = 0;
  for (int j = first.y(); j < y; ++j) sheet |= std::uint64_t(run) << (8 * j);

  int x = first.x();
  while (x < kBlockSide && (left.words[std::size_t(x)] & sheet) == sheet) {
    left.words[std::size_t(x++)] &= ~sheet;
  }
  return {first, {x, y, z}};
}

}  // namespace

std::vector<CellRange> voxel_boxes(const BlockSet& set) {
  std::vector<CellRange> boxes;
  const BlockLayout& layout = set.layout();
  for (std::size_t index = 0; index < layout.block_count(); ++index) {
    if (set.none(index)) continue;
    const Eigen::Vector3i corner = kBlockSide * layout.block_at(index);
    for (BlockBits left = set.bits(index); !left.none();) {
      const CellRange box = take_box(left);
      boxes.push_back({corner + box.first, corner + box.last});
    }
  }
  return boxes;
}

}  // namespace vantage::detail
