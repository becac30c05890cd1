#include "scoring/voxel/visibility_counter.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "vantage/raycore/detail/multiversion.hpp"

namespace vantage::planner::detail {
namespace {

// Some 4,000 rays: small enough to stop within a fraction of a millisecond.
constexpr std::size_t kMaxPackets = 256;
// Fewer, or much fewer than were traced before, are not worth the look at the bounds in between.
constexpr std::size_t kFewestPackets = 4;

/// Points that are in view and not hidden, of four packets at a time.
[[gnu::always_inline]] inline std::uint64_t count_seen_body(const std::uint16_t* in_view,
                                                            const std::uint16_t* hidden,
                                                            std::size_t size) {
  std::uint64_t seen = 0;
  std::size_t i = 0;
  for (; i + 4 <= size; i += 4) {
    std::uint64_t view_bits, hidden_bits;
    std::memcpy(&view_bits, in_view + i, sizeof(view_bits));
    std::memcpy(&hidden_bits, hidden + i, sizeof(hidden_bits));
    seen += std::uint64_t(std::popcount(view_bits & ~hidden_bits));
  }
  for (; i < size; ++i) seen += std::uint64_t(std::popcount(unsigned(in_view[i] & ~hidden[i])));
  return seen;
}
constexpr Multiversion<count_seen_body> count_seen;

/// Moves a packet's points towards a place, by as much as a surface's band is thick at their
/// distance, and never past the middle of the way.
[[gnu::always_inline]] inline void move_towards_body(
    const float* __restrict x, const float* __restrict y, const float* __restrict z,
    const Eigen::Vector3f& to, float half, float half_1m, float* __restrict out_x,
    float* __restrict out_y, float* __restrict out_z) {
  const float to_x = to.x(), to_y = to.y(), to_z = to.z();
  for (std::size_t i = 0; i < kPacketWidth; ++i) {
    const float dx = to_x - x[i], dy = to_y - y[i], dz = to_z - z[i];
    const float squared = dx * dx + dy * dy + dz * dz;
    const float noise = half_1m * squared, band = noise > half ? noise : half;
    const float share = band / std::sqrt(squared), part = share < 0.5f ? share : 0.5f;
    out_x[i] = x[i] + part * dx, out_y[i] = y[i] + part * dy, out_z[i] = z[i] + part * dz;
  }
}
constexpr Multiversion<move_towards_body> move_towards;

/// Of a packet whose lanes are the lowest ones.
Score points_in(std::uint16_t lanes) {
  return Score(std::bit_width(lanes));
}

void fill_blocks(const PointPackets& set, std::size_t level, std::size_t box, InView in_view,
                 std::vector<InView>& blocks) {
  std::size_t each = 1;
  for (std::size_t i = 0; i < level; ++i) each *= kBlocksPerParent;
  const std::size_t first = box * each, last = std::min(first + each, set.blocks());
  std::fill(blocks.begin() + std::ptrdiff_t(first), blocks.begin() + std::ptrdiff_t(last), in_view);
}

}  // namespace

void SegmentTracer::occluded(const Eigen::Vector3d& centre, std::span<const std::uint32_t> packets,
                             std::span<const std::uint16_t> wanted,
                             std::span<std::uint16_t> hidden) {
  trace(obstacles_.front(), centre, packets, wanted, hidden);
  for (const Obstacles& obstacles : obstacles_.subspan(1)) {
    open_.resize(packets.size()), more_.resize(packets.size());
    for (std::size_t i = 0; i < packets.size(); ++i) open_[i] = wanted[i] & ~hidden[i];
    trace(obstacles, centre, packets, open_, more_);
    for (std::size_t i = 0; i < packets.size(); ++i) hidden[i] |= more_[i];
  }
}

void SegmentTracer::trace(const Obstacles& obstacles, const Eigen::Vector3d& centre,
                          std::span<const std::uint32_t> packets,
                          std::span<const std::uint16_t> wanted, std::span<std::uint16_t> hidden) {
  const Eigen::Vector3f to = centre.cast<float>();
  const auto least_m = float(obstacles.band.least_m), at_1m = float(obstacles.band.at_1m);
  if (least_m == 0 && at_1m == 0) {
    return obstacles.scene->occluded(points_, to, packets, wanted, hidden);
  }
  starts_.resize(packets.size() * kPacketWidth), in_order_.resize(packets.size());
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const std::size_t first = std::size_t(packets[i]) * kPacketWidth, out = i * kPacketWidth;
    in_order_[i] = std::uint32_t(i);
    move_towards(points_.x + first, points_.y + first, points_.z + first, to, least_m, at_1m,
                 &starts_.x[out], &starts_.y[out], &starts_.z[out]);
  }
  obstacles.scene->occluded(starts_, to, in_order_, wanted, hidden);
}

ViewCounter::ViewCounter(const PointPackets& set, std::span<const Obstacles> obstacles,
                         std::span<const PinholeCamera> views, std::span<const Score> needed)
    : set_(set), tracer_(set.points, obstacles), views_(views), needed_(needed) {}

void ViewCounter::run(const StopToken& stop, std::span<ScoreBound> results) {
  active_.reserve(views_.size()), found_.reserve(2 * kBlocksPerParent);
  for (std::size_t i = 0; i < views_.size(); ++i) admit(i, results[i]);
  while (!active_.empty() && done_ < set_.packets()) {
    if (stop.stop_requested()) {
      for (const View& view : active_) results[view.index] = {};
      return;
    }
    const std::size_t size = next_batch_size();
    look_at(std::span(set_.spread).subspan(done_, size));
    done_ += size;
    if (done_ < set_.packets()) drop_hopeless(results);
  }
  for (View& view : active_) {
    results[view.index] = {ScoreBound::Known::exact, view.bound};
    if (!kept_.empty()) kept_[view.index] = {set_.spread, std::move(view.seen)};
  }
}

/// Takes a view in if its boxes do not say enough. Most do, often the first few that are out of
/// view: what is noted of them is written out for those only that are taken in.
void ViewCounter::admit(std::size_t index, ScoreBound& result) {
  const ViewFrustum frustum(views_[index], set_.largest_coordinate);
  Score bound = set_.size;
  found_.clear();
  for_each_box(set_, frustum, [&](std::size_t level, std::size_t box, InView in_view) {
    if (in_view == InView::none) {
      bound -= set_.points_below(level, box);
      return bound >= needed_[index];
    }
    found_.push_back({level, box, in_view});
    return true;
  });
  if (bound == 0) {
    result = {ScoreBound::Known::exact, 0};
  } else if (bound < needed_[index]) {
    result = {ScoreBound::Known::at_most, bound};
  } else {
    active_.push_back({index, bound, blocks_found()});
  }
}

std::vector<InView> ViewCounter::blocks_found() const {
  const FoundBox& first = found_.front();
  if (first.in_view == InView::all && first.level + 1 == set_.levels.size()) return {};
  std::vector<InView> blocks(set_.blocks(), InView::none);
  for (const FoundBox& found : found_) {
    fill_blocks(set_, found.level, found.box, found.in_view, blocks);
  }
  return blocks;
}

/// No view can be out before as many packets as its bound has points to lose.
std::size_t ViewCounter::next_batch_size() const {
  Score least = ~Score(0);
  for (const View& view : active_) least = std::min(least, view.bound - needed_[view.index]);
  const std::size_t wanted = std::size_t(std::min<Score>(least / kPacketWidth + 1, kMaxPackets));
  const std::size_t worth_it = std::max(kFewestPackets, std::min(done_, kMaxPackets));
  return std::min(std::max(wanted, worth_it), set_.packets() - done_);
}

void ViewCounter::look_at(std::span<const std::uint32_t> packets) {
  const std::size_t size = packets.size();
  lanes_.resize(size), hidden_.resize(size), wanted_.assign(size, 0);
  for (std::size_t i = 0; i < size; ++i) lanes_[i] = set_.lanes(packets[i]);
  in_view_.resize(active_.size() * size);
  for (std::size_t v = 0; v < active_.size(); ++v) {
    std::uint16_t* const in_view = &in_view_[v * size];
    active_[v].bound -= find_in_view(active_[v], packets, in_view);
    for (std::size_t i = 0; i < size; ++i) wanted_[i] |= in_view[i];
  }
  tracer_.occluded(views_[0].centre(), packets, wanted_, hidden_);
  for (std::size_t v = 0; v < active_.size(); ++v) {
    const std::uint16_t* const in_view = &in_view_[v * size];
    active_[v].bound += count_seen(in_view, hidden_.data(), size);
    if (kept_.empty()) continue;
    for (std::size_t i = 0; i < size; ++i) active_[v].seen.push_back(in_view[i] & ~hidden_[i]);
  }
}

/// @returns how many of the packets' points the view's bound had counted so far.
Score ViewCounter::find_in_view(const View& view, std::span<const std::uint32_t> packets,
                                std::uint16_t* in_view) {
  Score counted = 0;
  if (view.blocks.empty()) {
    std::copy(lanes_.begin(), lanes_.end(), in_view);
    for (const std::uint16_t lanes : lanes_) counted += points_in(lanes);
    return counted;
  }
  unsure_.resize(packets.size()), unsure_at_.resize(packets.size());
  std::size_t unsure = 0;
  for (std::size_t i = 0; i < packets.size(); ++i) {
    const InView block = view.blocks[packets[i] / kPacketsPerBlock];
    unsure_[unsure] = packets[i], unsure_at_[unsure] = std::uint32_t(i);
    unsure += block == InView::some;
    in_view[i] = block == InView::all ? lanes_[i] : std::uint16_t(0);
    counted += block == InView::none ? 0 : points_in(lanes_[i]);
  }
  unsure_masks_.resize(unsure);
  views_[view.index].in_view(set_.points, std::span(unsure_).first(unsure), unsure_masks_);
  for (std::size_t j = 0; j < unsure; ++j) {
    const std::uint32_t i = unsure_at_[j];
    in_view[i] = lanes_[i] & unsure_masks_[j];
  }
  return counted;
}

void ViewCounter::drop_hopeless(std::span<ScoreBound> results) {
  std::erase_if(active_, [&](const View& view) {
    if (view.bound >= needed_[view.index]) return false;
    results[view.index] = {ScoreBound::Known::at_most, view.bound};
    return true;
  });
}

std::vector<std::uint16_t> in_view_masks(const PointPackets& set, const PinholeCamera& view) {
  std::vector<std::uint16_t> masks(set.packets());
  view.in_view(set.points, set.spread, masks);
  for (std::size_t i = 0; i < masks.size(); ++i) masks[i] &= set.lanes(set.spread[i]);
  return masks;
}

}  // namespace vantage::planner::detail
