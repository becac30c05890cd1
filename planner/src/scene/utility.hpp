#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "vantage/planner/plan_options.hpp"
#include "vantage/planner/view_scorer.hpp"

namespace vantage::planner::detail {

/// What is left of a score after travel cost, in integers: a share of 2^32 parts.
class Utility {
 public:
  explicit Utility(const std::optional<TravelCost>& travel) : travel_(travel) {}

  /// The share for a camera at `centre`; 2^32 is all of it.
  std::uint64_t share(const Eigen::Vector3d& centre) const {
    if (!travel_) return kWhole;
    const double kept = std::exp(-travel_->weight_per_m * (centre - travel_->from_m).norm());
    return std::uint64_t(std::llround(kept * double(kWhole)));
  }

  /// ⌊score · share / 2^32⌋, without overflow.
  static Score of(Score score, std::uint64_t share) {
    const std::uint64_t high = score >> 32, low = score & 0xFFFFFFFFu;
    return high * share + (low * share >> 32);
  }

  /// The least score with which `of` is at least `utility`.
  static Score needed(Score utility, std::uint64_t share) {
    if (share == kWhole || utility == 0) return utility;
    Score low = utility, high = std::numeric_limits<Score>::max();  // `of` never grows a score
    if (of(high, share) < utility) return high;
    while (low < high) {
      const Score middle = low + (high - low) / 2;
      of(middle, share) >= utility ? high = middle : low = middle + 1;
    }
    return low;
  }

 private:
  static constexpr std::uint64_t kWhole = std::uint64_t(1) << 32;
  std::optional<TravelCost> travel_;
};

}  // namespace vantage::planner::detail
