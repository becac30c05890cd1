#include "voting/vote_table.hpp"

#include <utility>

namespace vantage::reconstruction::detail {
namespace {

std::uint64_t mixed(std::uint64_t h) {  // the finaliser of MurmurHash3
  h ^= h >> 33;
  h *= 0xff51afd7ed558ccdULL;
  h ^= h >> 33;
  h *= 0xc4ceb9fe1a85ec53ULL;
  return h ^ (h >> 33);
}

/// One of a key and its negative.
void drop_sign(std::array<std::int32_t, 4>& key) {
  for (const std::int32_t first : key) {
    if (first > 0) return;
    if (first < 0) break;
  }
  for (std::int32_t& k : key) k = -k;
}

}  // namespace

VoteTable::VoteTable(const VoteGrid& grid) : grid_(grid), slots_(64) {}

bool VoteTable::has_room_for(const VotePlace& place) const {
  const Eigen::Array3d cells = (place.p_m - grid_.origin_m).array().abs() / grid_.cell_m;
  return (cells <= kFarthestCells).all();  // false for NaN too
}

std::array<VoteTable::Share, VoteTable::kCellsPerVote> VoteTable::shares(
    const VotePlace& place, std::int64_t weight) const {
  const auto positions = lattice_corners<3>((place.p_m - grid_.origin_m) / grid_.cell_m);
  auto turns = lattice_corners<4>(grid_.frame * place.turn / grid_.cell_rad);
  if (place.both_signs) {
    for (auto& turn : turns) drop_sign(turn.key);
  }
  std::array<Share, kCellsPerVote> result;
  std::int64_t left = weight;
  std::size_t n = 0, heaviest = 0;
  for (const auto& p : positions) {
    for (const auto& t : turns) {
      const std::int64_t part = std::int64_t(double(weight) * p.weight * t.weight);
      result[n] = {{std::int32_t(place.type), p.key[0], p.key[1], p.key[2], t.key[0], t.key[1],
                    t.key[2], t.key[3]},
                   part};
      if (part > result[heaviest].weight) heaviest = n;
      left -= part;
      ++n;
    }
  }
  result[heaviest].weight += left;  // rounding loses nothing
  return result;
}

std::size_t VoteTable::slot_of(const Key& key) const {
  std::uint64_t hash = 0;
  for (std::size_t i = 0; i < key.size(); i += 2) {
    hash = mixed(hash ^ (std::uint64_t(std::uint32_t(key[i])) << 32 | std::uint32_t(key[i + 1])));
  }
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = hash & mask;
  while (slots_[at].used && slots_[at].key != key) at = (at + 1) & mask;
  return at;
}

void VoteTable::expand_consensus() {
  std::vector<Slot> old = std::exchange(slots_, std::vector<Slot>(2 * slots_.size()));
  for (const Slot& slot : old) {
    if (slot.used) slots_[slot_of(slot.key)] = slot;
  }
}

void VoteTable::add(const VotePlace& place, std::int64_t weight) {
  for (const Share& share : shares(place, weight < 0 ? -weight : weight)) {
    if (share.weight == 0) continue;
    Slot& slot = slots_[slot_of(share.key)];
    if (!slot.used) {
      slot = {share.key, 0, true};
      ++used_;
    }
    slot.votes += weight < 0 ? -share.weight : share.weight;
    if (4 * used_ > 3 * slots_.size()) expand_consensus();
  }
}

double VoteTable::height(const VotePlace& place) const {
  double common = 0, own = 0;  // what a single vote here would find of itself
  for (const Share& share : shares(place, kOneVote)) {
    own += double(share.weight) * double(share.weight);
    const Slot& slot = slots_[slot_of(share.key)];
    if (slot.used) common += double(share.weight) * double(slot.votes);
  }
  return common / own;
}

}  // namespace vantage::reconstruction::detail
