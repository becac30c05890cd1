#include "vantage/volume/advanced/shadow_regions.hpp"

#include "grid/openvdb.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>

#include "grid/state_grid_impl.hpp"
#include "shadow/shadow_blocks.hpp"

namespace vantage {
namespace volume::detail {
namespace {

/// Where the 8 bits of each byte, and the 8 bytes, have a 1 in binary place 0, 1 and 2.
constexpr std::uint64_t kZHas[3] = {0xaaaaaaaaaaaaaaaa, 0xcccccccccccccccc, 0xf0f0f0f0f0f0f0f0};
constexpr std::uint64_t kYHas[3] = {0xff00ff00ff00ff00, 0xffff0000ffff0000, 0xffffffff00000000};

/// Sum of a coordinate over the bits that are on.
std::uint64_t sum_of(std::uint64_t bits, const std::uint64_t (&has)[3]) {
  std::uint64_t sum = 0;
  for (int place = 0; place < 3; ++place) {
    sum += std::uint64_t(std::popcount(bits & has[place])) << place;
  }
  return sum;
}

std::array<int, 3> in_order(const Eigen::Vector3i& v) {
  return {v.x(), v.y(), v.z()};
}

/// What a region's voxels add up to, in integers.
class RegionSums {
  using Integers = Eigen::Matrix<std::uint64_t, 3, 1>;

 public:
  void add(const openvdb::Coord& origin, const BlockWords& words, const BlockWords& unmeasured,
           const BlockWords& outside) {
    const std::uint64_t before = voxels_;
    Integers local = Integers::Zero();
    for (std::size_t x = 0; x < 8; ++x) {
      if (words[x] == 0) continue;
      const auto count = std::uint64_t(std::popcount(words[x]));
      voxels_ += count;
      unmeasured_ += std::uint64_t(std::popcount(words[x] & unmeasured[x]));
      outside_ += std::uint64_t(std::popcount(words[x] & outside[x]));
      local[0] += x * count;
      local[1] += sum_of(words[x], kYHas);
      local[2] += sum_of(words[x], kZHas);
      extend(to_voxel(origin) + Eigen::Vector3i(int(x), 0, 0), words[x]);
    }
    sum_ += local + (voxels_ - before) * to_voxel(origin).cast<std::uint64_t>();
  }

  ShadowRegion region(const GridGeometry& geometry) const {
    const Eigen::Vector3d mean = sum_.cast<double>() / double(voxels_);
    return {voxels_,
            unmeasured_,
            outside_,
            first_,
            min_,
            max_,
            geometry.centre(Eigen::Vector3i::Zero()) + geometry.voxel_size_m() * mean};
  }

 private:
  void extend(const Eigen::Vector3i& row, std::uint64_t bits) {
    const int lowest = std::countr_zero(bits), highest = 63 - std::countl_zero(bits);
    const Eigen::Vector3i first = row + Eigen::Vector3i(0, lowest >> 3, lowest & 7);
    if (in_order(first) < in_order(first_)) first_ = first;
    bits |= bits >> 32, bits |= bits >> 16, bits |= bits >> 8;  // which z there are, at any y
    const auto z = unsigned(bits & 0xff);
    const Eigen::Vector3i low(0, lowest >> 3, std::countr_zero(z));
    const Eigen::Vector3i high(0, highest >> 3, std::bit_width(z) - 1);
    min_ = min_.cwiseMin(row + low);
    max_ = max_.cwiseMax(row + high);
  }

  static constexpr int kFar = std::numeric_limits<int>::max();
  std::uint64_t voxels_ = 0, unmeasured_ = 0, outside_ = 0;
  Integers sum_ = Integers::Zero();  // at most 2^30 voxels and 2^30 along an axis: no overflow
  Eigen::Vector3i first_ = Eigen::Vector3i::Constant(kFar);
  Eigen::Vector3i min_ = Eigen::Vector3i::Constant(kFar);
  Eigen::Vector3i max_ = Eigen::Vector3i::Constant(-1);
};

bool goes_before(const ShadowRegion& a, const ShadowRegion& b) {
  if (a.voxels != b.voxels) return a.voxels > b.voxels;
  return in_order(a.first_voxel) < in_order(b.first_voxel);
}

/// Numbers the sets that `lowest` names, from 0; `numbers` gets each component's.
std::size_t number_sets(const std::vector<std::uint32_t>& lowest,
                        std::vector<std::int32_t>& numbers) {
  std::int32_t count = 0;
  for (std::size_t c = 0; c < lowest.size(); ++c) {
    numbers[c] = lowest[c] == c ? count++ : numbers[lowest[c]];
  }
  return std::size_t(count);
}

}  // namespace
}  // namespace volume::detail

struct ShadowRegions::Impl {
  GridGeometry geometry;
  volume::detail::ShadowBlocks blocks;
  std::vector<std::int32_t> labels;  ///< by component
  std::vector<ShadowRegion> list;

  explicit Impl(const StateGrid& grid)
      : geometry(grid.geometry()), blocks(grid.impl().shadow), labels(blocks.component_count()) {
    std::vector<volume::detail::RegionSums> sums(
        volume::detail::number_sets(blocks.connected(), labels));
    volume::detail::BlockReader unmeasured_at(grid.impl().unmeasured);
    volume::detail::BlockReader outside_at(grid.impl().outside);
    for (const volume::detail::ShadowBlock& block : blocks.list()) {
      const volume::detail::BlockWords unmeasured = unmeasured_at.words(block.origin);
      const volume::detail::BlockWords outside = outside_at.words(block.origin);
      const std::int32_t* label = &labels[block.first_component];
      for (const volume::detail::BlockWords& words : block.component_words()) {
        sums[std::size_t(*label++)].add(block.origin, words, unmeasured, outside);
      }
    }
    for (const volume::detail::RegionSums& sum : sums) list.push_back(sum.region(geometry));
    sort_by_size();
  }

  void sort_by_size() {
    std::vector<std::size_t> order(list.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return volume::detail::goes_before(list[a], list[b]);
    });
    std::vector<std::int32_t> label_of(list.size());
    std::vector<ShadowRegion> sorted;
    for (const std::size_t i : order) {
      sorted.push_back(list[i]);
      label_of[i] = std::int32_t(sorted.size());
    }
    list = std::move(sorted);
    for (std::int32_t& label : labels) label = label_of[std::size_t(label)];
  }

  std::int32_t label_in(const volume::detail::ShadowBlock& block,
                        const openvdb::Coord& voxel) const {
    const int x = voxel.x() & 7, bit = ((voxel.y() & 7) << 3) | (voxel.z() & 7);
    if (!(block.words[std::size_t(x)] >> bit & 1)) return 0;
    return labels[block.component_of(std::size_t(64 * x + bit))];
  }
};

ShadowRegions::ShadowRegions(const StateGrid& grid) : impl_(std::make_unique<const Impl>(grid)) {}
ShadowRegions::~ShadowRegions() = default;
ShadowRegions::ShadowRegions(ShadowRegions&&) noexcept = default;
ShadowRegions& ShadowRegions::operator=(ShadowRegions&&) noexcept = default;

const GridGeometry& ShadowRegions::geometry() const noexcept {
  return impl_->geometry;
}

const std::vector<ShadowRegion>& ShadowRegions::list() const noexcept {
  return impl_->list;
}

std::int32_t ShadowRegions::label(const Eigen::Vector3i& voxel) const {
  const openvdb::Coord place = volume::detail::to_coord(voxel);
  auto places = impl_->blocks.accessor();
  const volume::detail::ShadowBlock* const block = impl_->blocks.at(places, place);
  return block == nullptr ? 0 : impl_->label_in(*block, place);
}

void ShadowRegions::labels_of_row(int i, int j, std::int32_t* row) const {
  const int length = geometry().size().z();
  auto places = impl_->blocks.accessor();
  for (int first = 0; first < length; first += 8) {
    const volume::detail::ShadowBlock* const block = impl_->blocks.at(places, {i, j, first});
    for (int k = first; k < std::min(first + 8, length); ++k) {
      row[k] = block == nullptr ? 0 : impl_->label_in(*block, {i, j, k});
    }
  }
}

}  // namespace vantage
