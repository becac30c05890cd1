#include "shadow/shadow_blocks.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>

namespace vantage::volume::detail {
namespace {

void split(ShadowBlock& block) {
  if (count_on(block.words) == 512) return;
  const std::vector<BlockWords> components = local_components(block.words);
  block.components = std::uint32_t(components.size());
  if (components.size() < 2) return;
  auto numbers = std::make_unique<std::array<std::uint8_t, 512>>();
  for (std::size_t c = 0; c < components.size(); ++c) {
    for_each_on(components[c], [&](int x, int y, int z) {
      (*numbers)[std::size_t(64 * x + 8 * y + z)] = std::uint8_t(c);
    });
  }
  block.numbers = std::move(numbers);
}

/// Disjoint sets of components, each named by its lowest.
class Sets {
 public:
  explicit Sets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0u); }

  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) {
    a = find(a), b = find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// Unites the components that meet where `block` and the `next` one along an axis do.
void unite_across(const ShadowBlock& block, const ShadowBlock& next, std::size_t axis, Sets& sets) {
  static constexpr std::size_t kStep[3] = {64, 8, 1};
  const std::size_t across = 7 * kStep[axis];
  const std::size_t u = kStep[(axis + 1) % 3], v = kStep[(axis + 2) % 3];
  for (std::size_t a = 0; a < 8; ++a) {
    for (std::size_t b = 0; b < 8; ++b) {
      const std::size_t there = a * u + b * v, here = there + across;
      if (!is_on(block.words, here) || !is_on(next.words, there)) continue;
      sets.unite(block.component_of(here), next.component_of(there));
      if (!block.numbers && !next.numbers) return;  // there is no more to unite
    }
  }
}

}  // namespace

std::vector<BlockWords> ShadowBlock::component_words() const {
  if (!numbers) return {words};
  std::vector<BlockWords> result(components);
  for_each_on(words, [&](int x, int y, int z) {
    const int bit = 8 * y + z;
    result[(*numbers)[std::size_t(64 * x + bit)]][std::size_t(x)] |= std::uint64_t(1) << bit;
  });
  return result;
}

ShadowBlocks::ShadowBlocks(const openvdb::MaskTree& voxels) {
  const std::vector<MaskBlock> masks = mask_blocks(voxels);
  list_.resize(masks.size());
  tbb::parallel_for(std::size_t(0), masks.size(), [&](std::size_t b) {
    list_[b].origin = masks[b].origin;
    list_[b].words = masks[b].words();
    split(list_[b]);
  });
  openvdb::tree::ValueAccessor<openvdb::Int32Tree> number_at(number_at_);
  for (std::size_t b = 0; b < list_.size(); ++b) {
    list_[b].first_component = component_count_;
    component_count_ += list_[b].components;
    number_at.setValueOn(list_[b].origin >> 3, std::int32_t(b));
  }
}

std::vector<std::uint32_t> ShadowBlocks::connected() const {
  Sets sets(component_count_);
  Accessor places = accessor();
  for (const ShadowBlock& block : list_) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      openvdb::Coord beyond = block.origin;
      beyond[axis] += 8;
      const ShadowBlock* const next = at(places, beyond);
      if (next != nullptr) unite_across(block, *next, axis, sets);
    }
  }
  std::vector<std::uint32_t> lowest(component_count_);
  for (std::uint32_t c = 0; c < component_count_; ++c) lowest[c] = sets.find(c);
  return lowest;
}

namespace {

constexpr std::uint64_t kLowZ = 0x0101010101010101;   // bits with z = 0
constexpr std::uint64_t kHighZ = 0x8080808080808080;  // bits with z = 7

/// The voxels themselves and their neighbours along y and z.
std::uint64_t spread_in_layer(std::uint64_t bits) {
  return bits | (bits << 8) | (bits >> 8) | ((bits & ~kHighZ) << 1) | ((bits & ~kLowZ) >> 1);
}

/// The lowest voxel alone; all off if none is on.
BlockWords lowest(const BlockWords& words) {
  BlockWords result{};
  for (std::size_t x = 0; x < 8; ++x) {
    if (words[x] == 0) continue;
    result[x] = words[x] & -words[x];
    break;
  }
  return result;
}

}  // namespace

BlockWords flooded(const BlockWords& seed, const BlockWords& within) {
  BlockWords reached = seed;
  for (bool grows = true; grows;) {
    grows = false;
    for (std::size_t x = 0; x < 8; ++x) {
      std::uint64_t next = spread_in_layer(reached[x]);
      if (x > 0) next |= reached[x - 1];
      if (x < 7) next |= reached[x + 1];
      next &= within[x];
      grows |= next != reached[x];
      reached[x] = next;
    }
  }
  return reached;
}

std::vector<BlockWords> local_components(const BlockWords& words) {
  std::vector<BlockWords> components;
  BlockWords rest = words;
  while (count_on(rest) > 0) {
    components.push_back(flooded(lowest(rest), rest));
    for (std::size_t x = 0; x < 8; ++x) rest[x] &= ~components.back()[x];
  }
  return components;
}

}  // namespace vantage::volume::detail
