#include "surface/face_patches.hpp"

#include <tbb/parallel_sort.h>

#include "grid/mask_blocks.hpp"

namespace vantage::volume::detail {
namespace {

/// Transposes 8 × 8 bits, bit 8 · row + column (Hacker's Delight, 7-3).
std::uint64_t transposed(std::uint64_t bits) {
  std::uint64_t swap = (bits ^ (bits >> 7)) & 0x00aa00aa00aa00aa;
  bits ^= swap ^ (swap << 7);
  swap = (bits ^ (bits >> 14)) & 0x0000cccc0000cccc;
  bits ^= swap ^ (swap << 14);
  swap = (bits ^ (bits >> 28)) & 0x00000000f0f0f0f0;
  return bits ^ swap ^ (swap << 28);
}

/// Words along x, bits (y, z), become words along y, bits (z, x); once more, along z, bits (x, y).
BlockWords turned(const BlockWords& words) {
  BlockWords result;
  for (int y = 0; y < 8; ++y) {
    std::uint64_t layer = 0;  // bits (x, z)
    for (int x = 0; x < 8; ++x) {
      layer |= (words[std::size_t(x)] >> (8 * y) & 0xff) << (8 * x);
    }
    result[std::size_t(y)] = transposed(layer);
  }
  return result;
}

BlockWords along(int axis, BlockWords words) {
  for (int turn = 0; turn < axis; ++turn) words = turned(words);
  return words;
}

/// Adds the faces of a block across one axis.
void add_patches(const MaskBlock& block, int axis, BlockReader& at,
                 std::vector<FacePatch>& patches) {
  openvdb::Coord below = block.origin, above = block.origin;
  below[axis] -= 8;
  above[axis] += 8;
  const BlockWords words_below = at.words(below), words_above = at.words(above);
  const auto all_on = [](const BlockWords& words) { return count_on(words) == 512; };
  if (block.full() && all_on(words_below) && all_on(words_above)) return;

  const BlockWords layers = along(axis, block.words());
  const std::uint64_t last_below = along(axis, words_below)[7];
  const std::uint64_t first_above = along(axis, words_above)[0];
  const int row = block.origin[(axis + 1) % 3], column = block.origin[(axis + 2) % 3];
  for (std::size_t l = 0; l < 8; ++l) {
    const std::uint64_t down = layers[l] & ~(l > 0 ? layers[l - 1] : last_below);
    const std::uint64_t up = layers[l] & ~(l < 7 ? layers[l + 1] : first_above);
    const int position = block.origin[axis] + int(l);
    if (down != 0) patches.push_back({{std::int8_t(axis), -1, position}, row, column, down});
    if (up != 0) patches.push_back({{std::int8_t(axis), 1, position + 1}, row, column, up});
  }
}

/// The voxels in front of a patch's faces, as its bits.
std::uint64_t in_front(const FacePatch& patch, BlockReader& at) {
  const auto [axis, sign, position] = patch.plane;
  const int layer = sign > 0 ? position : position - 1;
  openvdb::Coord block;
  block[axis] = layer & ~7;
  block[(axis + 1) % 3] = patch.row;
  block[(axis + 2) % 3] = patch.column;
  const BlockWords words = at.words(block);
  return words == BlockWords{} ? 0 : along(axis, words)[std::size_t(layer & 7)];
}

}  // namespace

std::vector<FacePatch> face_patches(const openvdb::MaskTree& voxels) {
  std::vector<FacePatch> patches;
  BlockReader at(voxels);
  for (const MaskBlock& block : mask_blocks(voxels)) {
    for (int axis = 0; axis < 3; ++axis) add_patches(block, axis, at, patches);
  }
  tbb::parallel_sort(patches);
  return patches;
}

SplitPatches split(const std::vector<FacePatch>& patches, const openvdb::MaskTree& covering) {
  SplitPatches parts;
  BlockReader at(covering);
  const auto add = [](FacePatch patch, std::uint64_t faces, std::vector<FacePatch>& part) {
    patch.faces = faces;
    if (faces != 0) part.push_back(patch);
  };
  for (const FacePatch& patch : patches) {
    const std::uint64_t covered = patch.faces & in_front(patch, at);
    add(patch, patch.faces & ~covered, parts.open);
    add(patch, covered, parts.covered);
  }
  return parts;
}

}  // namespace vantage::volume::detail
